#include "robot/core/motion/drive_config.hpp"

namespace priamos::robot {

void DriveConfig::Describe(Archive& a) {
  a.Number("lost_position_m", lost_position_m,
           {"m", 0.05, 5, "no path is driven by a pose with a larger sigma"});
  a.Number("lost_yaw_deg", lost_yaw_deg,
           {"deg", 1, 90, "no path is driven by a pose with a larger sigma of the heading"});
  a.Number("blocked_s", blocked_s, {"s", 0, 60, "standing before an obstacle for this long is BLOCKED"});
  a.Number("waits_s", waits_s, {"s", 0.5, 60, "standing on a path for this long is BLOCKED, too"});
  a.Number("no_nearer_s", no_nearer_s,
           {"s", 1, 600, "so is coming no nearer to the end of a path for this long, though the base moves"});
  a.Number("operator_margin_m", operator_margin_m,
           {"m", 0, 0.5,
            "added to the margins of collision for an operator, and where a line may be left by little"});
  a.Number("fix_needed_m", fix_needed_m, {"m", 0.01, 5, "a silent head matters when sigma is larger"});
  a.Section("footprint", footprint, "the body of the base");
  a.Section("follower", follower, "how a path is driven");
  a.Section("corridor", corridor, "which walls are those of a corridor that is followed");
  a.Section("yield", yield, "how room is made for who comes along a corridor");
  a.Section("acceleration", acceleration, "limits while a path is driven");
  a.Section("operator_acceleration", operator_acceleration, "limits while an operator drives");
  a.Section("braking", braking, "limits while a hold brakes the base");
  a.Section("echoes", echoes, "which sonar echoes are believed");
  a.Section("floor", floor, "what the laser's line showed of the floor");
  a.Section("hanging", hanging, "which things that the head sees the base keeps off by itself");
  a.Section("movers", movers, "what comes towards the base while a path is driven");
  a.Section("approach", approach, "what closes in on the base from any side");
  a.Section("meeting", meeting, "standing for who is about to walk into the base");
  a.Section("collision", collision, "the last filter before the wheels");
  a.Section("touch", touch, "how a touch is noticed");
  a.Section("authority", authority, "who may drive");
  a.Section("failsafe", failsafe, "when silence is too long");
}

}  // namespace priamos::robot
