#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/archive.hpp"
#include "common/ground_plan.hpp"
#include "planner/core/map/wall_faces.hpp"
#include "planner/core/missions/mission.hpp"
#include "planner/core/missions/path_progress.hpp"
#include "planner/core/missions/pose_keeper.hpp"
#include "planner/core/path/route_planner.hpp"

namespace priamos::planner {

/// Speed, tolerances and limits of a mission to a place.
struct GotoMissionConfig {
  double speed_m_s = 0.30;
  double near_m = 0.10;  ///< distance to the goal at which the mission is done ...
  /// The same where the robot was stopped again and again by what stands there: no nearer place is to be had.
  double beside_m = 0.3;
  double turned_deg = 5;  ///< ... and the difference in heading, if the heading counts
  int retries = 3;        ///< other ways that are tried after something was in the way
  double stands_s = 30;   ///< a robot that holds on its way for so long has the mission fail
  double idle_s = 12;     ///< a robot that comes no further for so long, held by nothing, is blocked
  int waits = 3;          ///< times that it waits, where there is no other way, for who may go away ...
  double wait_s = 8;      ///< ... and how long
  double thing_m = 0.5;   ///< size of what is in the way, of which one side is known only
  MissionLimits limits{.resend_path_s = 4, .blocked_s = 3, .silent_s = 8, .limit_s = 600};
  RoutePlannerConfig route;
  PoseKeeperConfig keep;

  void Describe(Archive& a);
};

/// The mission "go there": a route through the room, driven in pieces of as many lines as a PATH holds. What
/// stops the robot on the way is put on the map where it stands, for the length of the mission, and another
/// way is looked for; the robot itself goes around what leaves room beside its line. Looks at doors in sight
/// keep the pose known, and where there are none the walls of the plan that are beside the path.
class GotoMission : public Mission {
 public:
  GotoMission(const GotoMissionConfig& config, const Footprint& footprint, const GroundPlan& plan);

  /// Begins the mission; it is refused when the goal is not finite.
  std::optional<Refusal> Start(const MissionOrder& order) override;
  void Step(MissionControl& control) override;
  void OnStop(MissionControl& control, const Stop& stop) override;
  /// Changes speeds, distances and times; what was ordered with others stays.
  void set_config(const GotoMissionConfig& config) { config_ = config; }
  const MissionLimits& limits() const override { return config_.limits; }
  std::string Unfinished() const override { return "not at the goal"; }

 private:
  void Depart(MissionControl& control, const std::string& why);
  void WaitOrFail(MissionControl& control, const std::string& why, const std::string& no_way);
  void ChooseGoal(const Pose2& map_from_base);
  void Drive(MissionControl& control, PlannedPath path, const std::string& why);
  void SendWalls(MissionControl& control);
  void Learn(const MissionControl& control);
  void Reconsider(MissionControl& control);
  void Arrive(MissionControl& control);
  void GiveUp(MissionControl& control, const std::string& reason);
  bool IsWithin(double distance_m, const Pose2& map_from_base) const;

  GotoMissionConfig config_;
  Footprint footprint_;
  RoutePlanner planner_;
  PoseKeeper keeper_;
  std::vector<WallFace> faces_;     ///< of the plan
  std::optional<Time> walls_sent_;  ///< those beside the path
  Goal goal_;
  int departures_ = 0;                           ///< after a stop
  std::shared_ptr<const LearnedWalls> learned_;  ///< as they were taken into account
  int waits_ = 0;                                ///< since the order
  std::optional<Time> waits_since_;              ///< for the way to become free
  ProgressWatch progress_;
  bool whole_ = true;  ///< the path ordered last leads to the goal
};

}  // namespace priamos::planner
