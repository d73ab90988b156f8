#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "common/archive.hpp"
#include "planner/core/locate/leg_choice.hpp"
#include "planner/core/locate/place_evidence.hpp"
#include "planner/core/missions/mission_control.hpp"

namespace priamos::planner {

/// How far a place is looked for by driving.
struct LocateLegsConfig {
  double speed_m_s = 0.25;
  double leeway_m = 0.4;  ///< how far a leg may be left around things
  double most_m = 80;     ///< driven in search of walls
  int most_legs = 40;
  int same_legs = 2;    ///< legs after which candidates that stay the same do not get fewer
  double same_m = 6;    ///< and so far driven by then
  int few = 4;          ///< candidates that looks decide quicker than legs ...
  int few_matched = 4;  ///< ... the best of which has so many walls
  LegChoiceConfig choice;

  void Describe(Archive& a);
};

/// Drives without a map: leg by leg to where the most is new, back along its way where nothing is new around,
/// until the walls that were heard leave few places or nothing new can be heard.
class LocateLegs {
 public:
  explicit LocateLegs(const LocateLegsConfig& config) : config_(config) {}

  void Reset();
  /// Orders the next leg, or the way back to where it begins; false: there is none, or it was driven enough.
  bool Next(MissionControl& control, const PlaceEvidence& evidence);
  /// The base has come to the end of what was ordered. Whether the places that are left are worth a look, or
  /// do not get fewer: then it stops.
  bool IsEnough(const PlaceEvidence& evidence);
  /// Something was in the way.
  void OnBlocked(const PlaceEvidence& evidence);
  int driven() const { return legs_; }

 private:
  LocateLegsConfig config_;
  std::vector<ClosedWay> closed_;
  Eigen::Vector2d towards_{1, 0};  ///< of the leg that is driven, frame of the way
  int legs_ = 0, same_legs_ = 0;
  std::size_t count_before_ = 0;  ///< candidates at the end of the leg before
};

}  // namespace priamos::planner
