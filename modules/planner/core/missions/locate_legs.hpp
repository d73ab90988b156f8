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
  double lead = 5;      ///< log-odds by which a candidate is behind that is out once a door was seen
  int few = 4;          ///< candidates within that, which looks decide quicker than legs ...
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
  /// `rivals` (map_from_way) are the places that it should tell apart. What stopped the base closes ways
  /// until nothing else is left; then it is tried once more.
  bool Next(MissionControl& control, const PlaceEvidence& evidence, std::vector<Pose2> rivals);
  /// The base has come to the end of what was ordered. Whether the places that are left are worth a look, or
  /// do not get fewer: then it stops.
  bool IsEnough(const PlaceEvidence& evidence);
  /// Something was in the way.
  void OnBlocked(const PlaceEvidence& evidence);
  int driven() const { return legs_; }

 private:
  std::vector<Pose2> Choose(const PlaceEvidence& evidence, LegHints hints) const;

  LocateLegsConfig config_;
  std::vector<ClosedWay> closed_;
  Eigen::Vector2d towards_{1, 0};  ///< of the leg that is driven, frame of the way
  int legs_ = 0, same_legs_ = 0;
  std::size_t count_before_ = 0;  ///< rivals at the end of the leg before
  std::size_t forgiven_ = 0;      ///< stops that close no way any more ...
  bool forgave_ = false;          ///< ... because nothing else was left, once
};

}  // namespace priamos::planner
