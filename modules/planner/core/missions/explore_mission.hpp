#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/archive.hpp"
#include "common/ground_plan.hpp"
#include "planner/core/explore/exploration.hpp"
#include "planner/core/explore/seen_floor.hpp"
#include "planner/core/graph/floor_graph.hpp"
#include "planner/core/missions/mission.hpp"
#include "planner/core/missions/path_progress.hpp"
#include "planner/core/path/route_planner.hpp"

namespace priamos::planner {

/// Speed, tolerances and limits of exploring a floor.
struct ExploreMissionConfig {
  double speed_m_s = 0.30;
  double near_m = 0.3;        ///< distance to the goal at which it counts as reached
  double reconsider_s = 2.5;  ///< so often it is looked whether the frontier ahead is still one
  double stands_s = 30;       ///< a robot that holds on its way for so long has the mission fail
  double idle_s = 12;         ///< a robot that comes no further for so long, held by nothing, is blocked
  double thing_m = 0.3;       ///< size of what is in the way, of which one side is known only
  int retries = 3;            ///< paths that end elsewhere before a frontier is given up
  int rounds = 2;             ///< so often what was left is tried again in the end without more being seen
  MissionLimits limits{.resend_path_s = 4, .blocked_s = 3, .silent_s = 8, .limit_s = 3600};
  RoutePlannerConfig route{.most_poses = 60000};  ///< who has many frontiers does not search for one for long
  ExplorationConfig choice;
  FloorGraphConfig graph;

  void Describe(Archive& a);
};

/// The mission "see the whole floor": from frontier to frontier until none is left that can be reached. What
/// is free is known from where the base was and from the walls that it told, both put where the graph has
/// them; what stops it is put on the map where it stands, for the length of the mission. A frontier that
/// cannot be reached is left, with the reason; the outcome names the largest.
class ExploreMission : public Mission {
 public:
  ExploreMission(const ExploreMissionConfig& config, const Footprint& footprint, const GroundPlan& plan);

  std::optional<Refusal> Start(const MissionOrder& order) override;
  void Step(MissionControl& control) override;
  void OnStop(MissionControl& control, const Stop& stop) override;
  /// What was seen of the floor; nullopt before the first order.
  std::optional<SeenFloor> Seen();
  /// Changes speeds, distances and times; what was ordered with others stays.
  void set_config(const ExploreMissionConfig& config);
  const MissionLimits& limits() const override { return config_.limits; }
  std::string Unfinished() const override { return "the floor is not explored"; }

 private:
  /// How far the robot is with being told where it is.
  enum class Placing { kNo, kBrakes, kTold };
  void Note(MissionControl& control);
  Pose2 BaseOf(const MissionControl& control) const;
  void Order(MissionControl& control, PlannedPath path);
  void Learn(const Pose2& base);
  void Reconsider(MissionControl& control);
  void Arrive(MissionControl& control);
  void Next(MissionControl& control);
  bool BeginRound();
  bool GoBack(MissionControl& control);
  bool DriveTo(MissionControl& control, const FrontierGoal& frontier);
  std::string WhyNoWay(const Pose2& base, const FrontierGoal& frontier) const;
  void Finish(MissionControl& control);
  bool IsVague(const MissionControl& control) const;
  void Place(MissionControl& control);
  std::string Left() const;

  ExploreMissionConfig config_;
  Footprint footprint_;
  RoutePlanner planner_;
  Exploration exploration_;
  FloorGraph graph_;
  std::vector<GraphAnchor> trail_;  ///< of the places of the exploration's trail
  Pose2 ordered_by_;                ///< the robot's frame in the map when a path was ordered last
  StandWatch stands_, idles_{StandWatch::Counts::kFree};
  bool begun_ = false;  ///< there was an order
  std::optional<FrontierGoal> goal_;
  int missed_ = 0;                             ///< paths towards goal_ that ended elsewhere
  int rounds_ = 0;                             ///< in which what was left was tried again
  double most_seen_m2_ = 0;                    ///< at the beginning of a round
  bool backing_ = false;                       ///< on the way back, to no frontier
  std::optional<Eigen::Vector2d> stopped_at_;  ///< where something stopped the base last
  bool undecided_ = false;                     ///< no way was found yet
  std::optional<Time> considered_;             ///< whether goal_ is still a frontier
  bool learned_ = false;                       ///< the map as it is now was taken into account
  Placing placing_ = Placing::kNo;
  Time braked_{};
  std::optional<std::string> outcome_;  ///< it is over but for the robot's pose
};

}  // namespace priamos::planner
