#include "world/core/scene/person_plan.hpp"

#include <algorithm>

#include "common/random.hpp"

namespace priamos::world {
namespace {

/// Nobody in a building walks faster where a robot drives, and nobody creeps.
constexpr double kFastest_m_s = 1.2, kSlowest_m_s = 0.2;

}  // namespace

void PersonStop::Describe(Archive& a) {
  a.Number("x_m", x_m, {"m", -100, 100, "map"});
  a.Number("y_m", y_m, {"m", -100, 100, "map"});
  a.Number("pause_s", pause_s, {"s", 0, 3600, "how long the person stands there"});
  a.Number("pause_spread_s", pause_spread_s, {"s", 0, 3600, "it is off by up to this, drawn every time"});
}

void PersonPlan::Describe(Archive& a) {
  NotePlace(a, place);
  a.Text("name", name, "for messages");
  a.Number("speed_m_s", speed_m_s, {"m/s", kSlowest_m_s, kFastest_m_s, "speed of walking"});
  a.Number("speed_spread_m_s", speed_spread_m_s,
           {"m/s", 0, 1, "it is off by up to this, drawn from the seed"});
  a.Number("spread_m", spread_m, {"m", 0, 2, "waypoints are off by up to this, drawn from the seed"});
  a.Number("chance", chance,
           {"-", 0, 1, "the person is there in this part of the runs, drawn from the seed"});
  a.Number("start_s", start_s, {"s", 0, 3600, "the person stands at the first waypoint until then"});
  a.Flag("attentive", attentive, "walks around the robot or stops before it; false: walks into it");
  a.List("waypoints", waypoints, "where the person walks, one after the other and again; one: stands there");
  if (waypoints.empty()) a.Refuse("waypoints", "at least one [[people.waypoints]]");
}

PersonPlan DrawPerson(PersonPlan plan, std::uint64_t seed) {
  Rng rng = Rng::Stream(seed, "person " + plan.name);
  plan.speed_m_s =
      std::clamp(plan.speed_m_s + rng.Uniform(-1, 1) * plan.speed_spread_m_s, kSlowest_m_s, kFastest_m_s);
  for (PersonStop& stop : plan.waypoints) {
    stop.x_m += rng.Uniform(-1, 1) * plan.spread_m;
    stop.y_m += rng.Uniform(-1, 1) * plan.spread_m;
  }
  return plan;
}

}  // namespace priamos::world
