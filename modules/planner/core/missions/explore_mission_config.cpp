#include "planner/core/missions/explore_mission_config.hpp"

namespace priamos::planner {

void ExploreMissionConfig::Describe(Archive& a) {
  a.Number("speed_m_s", speed_m_s, {"m/s", 0.05, 1, "on the way"});
  a.Number("near_m", near_m, {"m", 0.05, 1, "distance to a goal at which it counts as reached"});
  a.Number("reconsider_s", reconsider_s, {"s", 0.5, 60, "so often the frontier ahead is looked at anew"});
  a.Number("stands_s", stands_s,
           {"s", 1, 600, "a robot that holds on its way for so long fails the mission"});
  a.Number("idle_s", idle_s, {"s", 1, 600, "a robot that comes no further for so long is blocked"});
  a.Number("thing_m", thing_m, {"m", 0.1, 3, "size that something in the way is taken to have"});
  a.Number("meets_m", meets_m, {"m", 0, 3, "what is so near ahead is closed before it stops the base"});
  a.Integer("rounds", rounds, {"-", 0, 20, "rounds over what was left that see nothing more"});
  a.Integer("retries", retries, {"-", 0, 20, "paths that end elsewhere before a frontier is given up"});
  limits.Describe(a);
  a.Section("route", route, "the way to a frontier");
  a.Section("choice", choice, "which frontier is next");
  a.Section("graph", graph, "the map that is made, and where the robot is in it");
}

}  // namespace priamos::planner
