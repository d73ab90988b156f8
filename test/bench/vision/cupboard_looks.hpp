#pragma once

#include <cstdint>
#include <memory>

#include "test/bench/vision/landmark_looks.hpp"

namespace priamos::bench {

/// What is wrong with the scene, or nothing.
enum class CupboardTrouble { kNone, kAbsent, kAnother, kHalfHidden, kLightsOut, kOtherLight };
inline constexpr CupboardTrouble kCupboardTroubles[] = {CupboardTrouble::kAbsent, CupboardTrouble::kAnother,
                                                        CupboardTrouble::kHalfHidden,
                                                        CupboardTrouble::kLightsOut};
const char* Describe(CupboardTrouble trouble);

/// Draws stereo pairs of a cupboard of the map, 2 m before the head. Its size and place at the wall follow
/// the seed, and so does what stands and hangs beside it: another cupboard in every second scene. Its front
/// shows the frames of two doors 16 mm inside its arrises, which no map tells.
class CupboardPhotographer {
 public:
  CupboardPhotographer();
  LandmarkLook Take(std::uint64_t seed, CupboardTrouble trouble, const CalibratedHead& head, int visit = 0);

 private:
  std::shared_ptr<void> graphics_;
};

}  // namespace priamos::bench
