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
  a.Section("features", features, "when it is told");
  a.Section("drive", drive, "how the base moves, and what stops it");
}

}  // namespace priamos::robot
