#pragma once

#include <string>

#include "common/random.hpp"
#include "test/bench/vision/bodies/body_scenes.hpp"
#include "test/bench/vision/bodies/body_tally.hpp"

namespace priamos::bench {

/// How far off a search begins, and what share of such searches must succeed.
struct BodyStart {
  double share, turn_deg;  ///< of the distance; angle
  double success_percent;

  std::string Words() const;
};

inline constexpr BodyStart kNearStart{0.02, 1, 98}, kFarStart{0.06, 3, 85};

/// Searches for the body of one photograph from `n` places beside the truth, with the default options.
void AddStarts(const BodyScene& scene, const BodyStart& start, int n, Rng& rng, bool verbose,
               BodyTally& tally);

}  // namespace priamos::bench
