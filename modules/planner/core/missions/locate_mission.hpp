#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/archive.hpp"
#include "common/ground_plan.hpp"
#include "planner/core/locate/driven_way.hpp"
#include "planner/core/locate/leg_choice.hpp"
#include "planner/core/locate/place_search.hpp"
#include "planner/core/missions/door_views.hpp"
#include "planner/core/missions/look_sequence.hpp"
#include "planner/core/missions/mission.hpp"

namespace priamos::planner {

/// How far and how long a place is looked for, and what it takes to believe one.
struct LocateMissionConfig {
  double speed_m_s = 0.25;
  double leeway_m = 0.4;  ///< how far a leg may be left around things
  double most_m = 60;     ///< driven in search of walls
  int most_legs = 24;
  int same_legs = 3;         ///< legs after which candidates that stay the same do not get fewer
  double same_m = 8;         ///< and so far driven by then
  double settle_s = 9;       ///< the robot stands so long, so that the radio brings all that it heard
  int most_tests = 12;       ///< candidates that are looked at one after the other
  double alone_margin = 16;  ///< margin at which walls alone are believed where no door can be seen ...
  int alone_walls = 5;       ///< ... and so many of them
  double drift_m = 0.3;      ///< of the pose, one sigma, at which it counts as exact anew: it is relative
  MissionLimits limits{.resend_path_s = 4, .blocked_s = 3, .silent_s = 8, .limit_s = 900};
  PlaceSearchConfig search;
  LegChoiceConfig legs;
  LookConfig looks{.timeout_s = 5, .failures = 4, .looks = 16};

  void Describe(Archive& a);
};

/// The mission "where am I?": finds out where on the plan the robot is, whatever its pose says. It drives
/// short legs without a map and collects walls (WayLog) until one place on the plan explains them, or
/// driving on does not make the candidates fewer. Then it tells the robot that it is at one of them, drives
/// to where a door is to be seen from there and from none of the others, and looks. It believes what was seen
/// twice; the pose is taken back when nothing is. Where places cannot be told apart it ends "ambiguous".
class LocateMission : public Mission {
 public:
  LocateMission(const LocateMissionConfig& config, const RoutePlannerConfig& route,
                const Footprint& footprint, const GroundPlan& plan);

  std::optional<Refusal> Start(const MissionOrder& order) override;
  void Step(MissionControl& control) override;
  void OnStop(MissionControl& control, const Stop& stop) override;
  void OnEnded(MissionControl& control) override;
  const MissionLimits& limits() const override { return config_.limits; }
  std::string Unfinished() const override;

 private:
  enum class Stage { kFraming, kLeg, kSettling, kPlacing, kApproaching, kLooking, kGivingBack };
  /// A place that may be the one: map_from_way, and how well the walls tell it.
  struct Hypothesis {
    Pose2 map_from_way;
    double sigma_m = 0.2, sigma_yaw_rad = 0.05;
    double score = 0;
    int matched = 0;
  };

  void Listen(const MissionControl& control);
  void Search();
  void Frame(MissionControl& control);
  void NextLeg(MissionControl& control);
  void EndLeg(MissionControl& control);
  bool HasSettled(const MissionControl& control) const;
  void Decide(MissionControl& control);
  void BeginTests(MissionControl& control);
  void NextTest(MissionControl& control);
  void Approach(MissionControl& control);
  void Look(MissionControl& control);
  void Confirm(MissionControl& control);
  void Believe(MissionControl& control, const std::string& because);
  void BelieveWalls(MissionControl& control);
  void GiveUp(MissionControl& control, std::string reason);
  void GiveBack(MissionControl& control);
  bool HasArrived(const MissionControl& control) const;
  bool IsPlaced(const MissionControl& control) const;
  std::vector<Pose2> Others() const;
  Pose2 PlaceOf(const Hypothesis& hypothesis) const { return hypothesis.map_from_way * log_.way_from_base(); }
  std::string Candidates() const;
  void Tell(MissionControl& control, const std::string& what) const;

  LocateMissionConfig config_;
  PlacePlan places_;
  GroundPlan plan_;
  DoorViews views_;
  LookSequence looks_;
  Stage stage_ = Stage::kFraming;
  WayLog log_;
  std::size_t searched_ = 0;  ///< revision of the log
  double searched_at_m_ = 0;  ///< way driven by then
  std::vector<PlaceCandidate> found_;
  std::vector<Hypothesis> hypotheses_;
  std::size_t test_ = 0;  ///< index of the hypothesis that is looked at
  std::optional<DoorView> view_;
  std::vector<int> seen_doors_;  ///< looked at in this test, or out of reach
  int n_good_ = 0;               ///< looks that found the door
  std::vector<ClosedWay> closed_;
  int legs_ = 0, same_legs_ = 0;
  std::size_t count_before_ = 0;  ///< candidates at the end of the leg before
  Eigen::Vector2d leg_towards_{1, 0};
  Time stands_since_{};  ///< the end of the newest leg
  Time changed_{};       ///< when walls were told last
  std::string outcome_;  ///< reason with which the mission ends after the pose was given back
  bool framed_ = false;  ///< the robot's pose is one of this mission
};

}  // namespace priamos::planner
