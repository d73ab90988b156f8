#pragma once

#include <memory>
#include <vector>

#include "test/bench/rivals/rival_driver.hpp"

namespace priamos::bench {

/// Parameters of MRPT's methods that matter here. Distances in metres; they are handed over as parts of
/// `reach_m`, as the methods want them.
struct MrptConfig {
  double radius_m = 0, margin_m = 0.03;  ///< of the disc
  double reach_m = 2.0;                  ///< beyond this there is nothing
  int directions = 121;
  double too_close_m = 0.05;       ///< a direction that is free for less is not taken
  double slow_m = 0.3;             ///< below this it drives the slower
  double wide_gap = 0.25;          ///< ND: share of the circle from which on a gap is wide
  double risk_sectors = 0.10;      ///< ND: share of the circle on which its speed depends
  std::vector<double> weights;     ///< of its factors; none: MRPT's
  std::vector<double> thresholds;  ///< of FullEval's phases; none: MRPT's

  void Describe(Archive& a);
};

/// mrpt::nav::CHolonomicND: nearness diagram.
std::unique_ptr<Method> MrptNearness(const MrptConfig& config);
/// mrpt::nav::CHolonomicFullEval: every direction is weighed.
std::unique_ptr<Method> MrptFullEval(const MrptConfig& config);

}  // namespace priamos::bench
