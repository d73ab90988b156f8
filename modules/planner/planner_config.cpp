#include "planner/planner_config.hpp"

namespace priamos::planner {

void PlannerConfig::Describe(Archive& a) {
  a.Text("map", map, "ground plan, relative to the folder of this file");
  a.Text(
      "learned_map", learned_map,
      "file of walls that robots found, relative likewise; empty: they are forgotten when the planner ends");
  a.Number("rate_hz", rate_hz, {"Hz", 1, 100, "decisions"});
  a.Number("status_rate_hz", status_rate_hz, {"Hz", 0.2, 20, "MISSION_STATUS while nothing changes"});
  a.Number("model_period_s", model_period_s,
           {"s", 0, 600, "between two LANDMARK_MODELs: what link.toml has room for"});
  a.Section("footprint", footprint, "the robot's body");
  a.Section("passage", passage, "paths to a door and through it");
  a.Section("mission", mission, "how the mission through a door goes");
  a.Section("goto", go, "how the mission to a place goes");
  a.Section("corridor", corridor, "how a corridor is followed");
  a.Section("explore", explore, "how an unknown floor is explored");
  a.Section("locate", locate, "how a robot that does not know where it is finds out");
  a.Section("learned", learned, "which walls that robots found are the same");
  a.Section("doors", doors, "ways that lead through doors");
  a.Section("steps", steps, "how the steps of an order follow each other");
  // The next path that is ordered has them.
  using enum LiveChange;
  a.Live("mission.speed_m_s", kOnlyLower);
  a.Live("mission.look_from_m", kInRange);
  a.Live("mission.look_to_m", kInRange);
  a.Live("goto.speed_m_s", kOnlyLower);
  a.Live("goto.stands_s", kInRange);
  a.Live("corridor.speed_m_s", kOnlyLower);
  a.Live("corridor.leeway_m", kOnlyLower);
  a.Live("explore.speed_m_s", kOnlyLower);
}

}  // namespace priamos::planner
