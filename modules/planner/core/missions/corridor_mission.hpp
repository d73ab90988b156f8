#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "common/archive.hpp"
#include "common/ground_plan.hpp"
#include "planner/core/map/wall_faces.hpp"
#include "planner/core/missions/mission.hpp"
#include "planner/core/missions/pose_keeper.hpp"
#include "planner/core/path/footprint.hpp"

namespace priamos::planner {

/// Speed, tolerances and limits of following a corridor.
struct CorridorMissionConfig {
  double speed_m_s = 0.30;
  double leeway_m = 1.5;     ///< how far the middle may be left around things, if the walls leave room
  double parallel_deg = 25;  ///< a wall of the plan that is less askew gives the direction
  double end_m = 2;          ///< a corridor that ends so much before its end on the plan is closed there
  double open_m = 6;    ///< followed to its end, it ends where no wall was beside the robot for so long ...
  double beside_m = 3;  ///< ... nor nearer than this
  double patience_s = 60;   ///< so long the way may be closed, by a person above all, where it should lead on
  double back_off_m = 0.5;  ///< so far the robot goes back meanwhile, to hear anew what closes the way
  double back_off_m_s = 0.1;
  MissionLimits limits{.resend_path_s = 4, .blocked_s = 4, .silent_s = 8, .limit_s = 1200};
  PoseKeeperConfig keep;

  void Describe(Archive& a);
};

/// The mission "follow this corridor": one order to the robot, which keeps to the middle between the walls
/// that it hears. It needs no plan; where there is one, the robot is told the walls along the way. It ends
/// at the distance that was ordered, or where nothing leaves room for the base any more, or where it opens
/// into a hall. Where it should lead on, the robot waits, backs off and comes again before the corridor
/// counts as closed: who stands there may leave, and what was heard from one place only may be smaller. Looks
/// at doors of the plan keep the pose known, as on any drive: walls tell nothing of how far along them the
/// robot has come.
class CorridorMission : public Mission {
 public:
  CorridorMission(const CorridorMissionConfig& config, const Footprint& footprint, const GroundPlan& plan);

  /// Begins the mission; it is refused when the distance is none.
  std::optional<Refusal> Start(const MissionOrder& order) override;
  void Step(MissionControl& control) override;
  void OnStop(MissionControl& control, const Stop& stop) override;
  /// Changes speeds, distances and times; what was ordered with others stays.
  void set_config(const CorridorMissionConfig& config) { config_ = config; }
  const MissionLimits& limits() const override { return config_.limits; }
  std::string Unfinished() const override { return "still in the corridor"; }

 private:
  void Depart(MissionControl& control);
  void Follow(MissionControl& control, double length_m);
  void BackOff(MissionControl& control);
  bool MayLeadOn() const;
  void Close(MissionControl& control, const Stop& stop);
  bool IsBesideWall(const MissionControl& control) const;
  void EndInTheOpen(MissionControl& control);
  void End(MissionControl& control, std::string_view where);
  double CourseFrom(const Pose2& base) const;
  double Driven_m(const MissionControl& control) const;

  CorridorMissionConfig config_;
  Footprint footprint_;
  std::vector<WallFace> faces_;
  PoseKeeper keeper_;
  MissionOrder order_;
  Pose2 course_;                    ///< where the corridor was entered, and in which direction
  double length_m_ = 0;             ///< of the whole way that is to be followed
  double driven_m_ = 0;             ///< as reported last
  std::optional<double> beside_m_;  ///< driven when a wall was beside the robot last
  bool backs_off_ = false;          ///< the path ordered last leads back
  /// Where the way was found closed, and since when.
  struct Closed {
    double at_m = 0;
    Time since{};
    int n_looks = 0;
  };
  std::optional<Closed> closed_;
  std::optional<double> end_m_;  ///< to the corridor's end, as the plan has it
};

}  // namespace priamos::planner
