#include "robot/robot_config.hpp"

namespace priamos::robot {

void RobotConfig::Describe(Archive& a) {
  a.Number("rate_hz", rate_hz, {"Hz", 10, 200, "decisions and wheel commands"});
  a.Number("status_rate_hz", status_rate_hz, {"Hz", 0.5, 50, "DRIVE_STATUS"});
  a.Number("path_max_age_s", path_max_age_s, {"s", 0.5, 60, "an older path is refused"});
  a.Number("order_max_age_s", order_max_age_s,
           {"s", 0.1, 10, "older lease requests and re-armings are refused"});
  a.Text("state_file", state_file,
         "keeps a latched e-stop over a restart, and latches it after a crash; empty: neither");
  a.Section("base", base, "the four Mecanum wheels");
  a.Section("localiser", localiser, "where the base is");
  a.Section("opening", opening, "when sonars show that an opening was passed");
  a.Section("walls", walls, "straight walls that the planner is told of");
  a.Section("points", points, "corners and edges that the planner is told of");
  a.Section("features", features, "when it is told");
  a.Section("drive", drive, "how the base moves, and what stops it");
  // What can make the base unsafe moves to the careful side of the file only.
  using enum LiveChange;
  a.Live("drive.follower.shape.max_speed_m_s", kOnlyLower);
  a.Live("drive.follower.shape.max_turn_rad_s", kOnlyLower);
  a.Live("drive.operator_acceleration.acceleration_m_s2", kOnlyLower);
  a.Live("drive.operator_acceleration.turn_acceleration_rad_s2", kOnlyLower);
  a.Live("drive.operator_margin_m", kOnlyHigher);
  a.Live("drive.collision.margin_m", kOnlyHigher);
  a.Live("drive.collision.gap_m", kOnlyHigher);
  a.Live("drive.echoes.near_m", kOnlyHigher);
  a.Live("drive.echoes.keep_s", kOnlyHigher);
  a.Live("drive.lost_position_m", kOnlyLower);
  a.Live("drive.lost_yaw_deg", kOnlyLower);
  a.Live("drive.blocked_s", kInRange);
}

}  // namespace priamos::robot
