#pragma once

#include <optional>
#include <vector>

#include "common/archive.hpp"
#include "common/ground_plan.hpp"
#include "planner/core/map/wall_faces.hpp"
#include "planner/core/missions/mission.hpp"
#include "planner/core/path/footprint.hpp"

namespace priamos::planner {

/// Speed, tolerances and limits of following a corridor.
struct CorridorMissionConfig {
  double speed_m_s = 0.30;
  double leeway_m = 1.5;     ///< how far the middle may be left around things, if the walls leave room
  double parallel_deg = 25;  ///< a wall of the plan that is less askew gives the direction
  double end_m = 2;          ///< a corridor that ends so much before its end on the plan is closed there
  MissionLimits limits{.resend_path_s = 4, .blocked_s = 4, .silent_s = 8, .limit_s = 1200};

  void Describe(Archive& a);
};

/// The mission "follow this corridor": one order to the robot, which keeps to the middle between the walls
/// that it hears. It needs no plan; where there is one, the robot is told the walls along the way. It ends
/// at the distance that was ordered, or where nothing leaves room for the base any more.
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
  double CourseFrom(const Pose2& base) const;
  double Driven_m(const MissionControl& control) const;

  CorridorMissionConfig config_;
  Footprint footprint_;
  std::vector<WallFace> faces_;
  MissionOrder order_;
  double length_m_ = 0;          ///< of the path that was ordered
  std::optional<double> end_m_;  ///< to the corridor's end, as the plan has it
};

}  // namespace priamos::planner
