#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/ground_plan.hpp"
#include "common/outcome.hpp"
#include "planner/core/explore/exploration.hpp"
#include "planner/core/explore/seen_floor.hpp"
#include "planner/core/graph/anchored_objects.hpp"
#include "planner/core/graph/floor_graph.hpp"
#include "planner/core/missions/explore_mission_config.hpp"
#include "planner/core/missions/mission.hpp"
#include "planner/core/missions/path_progress.hpp"
#include "planner/core/path/route_planner.hpp"

namespace priamos::planner {

/// The mission "see the whole floor": from frontier to frontier until none is left that can be reached. What
/// is free is known from where the base was and from the walls that it told, both put where the graph has
/// them; what stops it is put on the map where it stands, for the length of the mission. A frontier that
/// cannot be reached is left, with the reason; the outcome names the largest. A base that has not moved, or
/// with frontiers left has not got away from where it began or cannot move any more, has failed: what is
/// around it may not be there.
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
  void NoteKnown(const LearnedWalls& known);
  void NoteObjects(const MissionControl& control);
  Pose2 BaseOf(const MissionControl& control) const;
  void Order(MissionControl& control, PlannedPath path);
  void Learn(const Pose2& base);
  void KeepOff(const FrontierGoal& goal, const Pose2& base);
  void NoteStop(const MissionControl& control);
  bool NoteThing(const MissionControl& control);
  void NoteAhead(const MissionControl& control);
  void Reconsider(MissionControl& control);
  void Arrive(MissionControl& control);
  void Next(MissionControl& control);
  bool IsShutIn(const Pose2& base) const;
  bool BeginRound();
  bool GoBack(MissionControl& control, double length_m);
  Outcome<PlannedPath> WayTo(const Pose2& base, const FrontierGoal& frontier);
  void DriveTo(MissionControl& control, const FrontierGoal& frontier, PlannedPath path);
  void Finish(MissionControl& control);
  std::string WhyNothing() const;
  void End(MissionControl& control);
  bool IsVague(const MissionControl& control) const;
  void Place(MissionControl& control);
  std::string Left() const;

  ExploreMissionConfig config_;
  Footprint footprint_;
  RoutePlanner planner_;
  Exploration exploration_;
  ObstacleMap drawn_;            ///< on the plan
  std::vector<DoorPlan> doors_;  ///< of the plan
  FloorGraph graph_;
  AnchoredObjects objects_;                    ///< that the head saw
  std::shared_ptr<const LearnedWalls> heard_;  ///< of which objects_ are
  bool saw_ = false;                           ///< there are others since the path was ordered
  std::vector<GraphAnchor> trail_;             ///< of the places of the exploration's trail
  Pose2 ordered_by_;                           ///< the robot's frame in the map when a path was ordered last
  ProgressWatch progress_;
  bool begun_ = false;  ///< there was an order
  std::optional<FrontierGoal> goal_;
  std::optional<Eigen::Vector2d> tried_;       ///< the border to which it drove last
  int missed_ = 0;                             ///< paths towards it that ended elsewhere
  int rounds_ = 0;                             ///< in which what was left was tried again
  double most_seen_m2_ = 0;                    ///< at the beginning of a round
  bool backing_ = false;                       ///< on the way back, to no frontier
  std::optional<Eigen::Vector2d> stopped_at_;  ///< where something stopped the base last
  std::optional<Eigen::Vector2d> stopped_by_;  ///< and what that was
  std::string in_the_way_;                     ///< of the path being driven; empty: nothing
  int stops_here_ = 0;                         ///< in a row at one place, after the first
  bool undecided_ = false;                     ///< no way was found yet
  std::optional<Time> considered_;             ///< whether goal_ is still a frontier
  bool learned_ = false;                       ///< the map as it is now was taken into account
  Placing placing_ = Placing::kNo;
  Time braked_{};
  std::optional<MissionState> outcome_;  ///< it is over but for the robot's pose
};

}  // namespace priamos::planner
