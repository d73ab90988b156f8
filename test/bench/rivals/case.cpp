#include "test/bench/rivals/case.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <stdexcept>

#include "test/bench/rivals/case_path.hpp"
#include "world/core/generate/clutter.hpp"
#include "world/core/generate/generate.hpp"
#include "world/core/generate/sketch.hpp"
#include "world/core/generate/strew.hpp"
#include "world/core/motion/movers.hpp"
#include "world/core/scene/build_solids.hpp"
#include "world/world_loading.hpp"

namespace priamos::bench {
namespace {

using Eigen::Vector2d;

/// Inner size of the hall of the made-up families, and where the way through it begins and ends.
constexpr double kLength_m = 9, kWidth_m = 6, kStart_m = 1.2, kGoal_m = 7.6;
/// What is lower is heard by no sonar: another question.
constexpr double kHeard_m = 0.6;
/// Room that even the circle around the base has beside it.
constexpr double kCircleBeside_m = 0.08;
constexpr double kFollowed_m = 8;  ///< of a corridor

world::Sketch Hall() {
  const double w = world::kHalfWall_m;
  return {{{"south", {-w, -w}, {kLength_m + w, -w}, {}},
           {"north", {kLength_m + w, kWidth_m + w}, {-w, kWidth_m + w}, {}},
           {"west", {-w, kWidth_m + w}, {-w, -w}, {}},
           {"east", {kLength_m + w, -w}, {kLength_m + w, kWidth_m + w}, {}}}};
}

/// A case under construction in the hall.
struct Draft {
  Rng rng;
  std::uint64_t seed;
  world::Sketch sketch = Hall();
  world::WorldPlan world{};
  Pose2 start{}, goal{};
  std::vector<Pose2> instead{};

  Draft(std::uint64_t case_seed, const std::string& family)
      : rng(Rng::Stream(case_seed, "rivals " + family)), seed(case_seed) {
    start = {kStart_m, kWidth_m / 2 + rng.Uniform(-0.3, 0.3), Radians(rng.Uniform(-15, 15))};
    goal = {kGoal_m, kWidth_m / 2 + rng.Uniform(-0.3, 0.3), 0};
  }
  std::vector<world::Solid> Solids() const { return world::BuildSolids(world::PlanOf(sketch), world, seed); }
};

Case Finished(const GroundPlan& plan, const Draft& draft) {
  Case made{draft.Solids(), {}, OrderBy(plan, draft.start, draft.goal, draft.instead)};
  for (const world::PersonPlan& person : draft.world.people)
    made.hazards.people.push_back(world::DrawPerson(person, draft.seed));
  return made;
}

Case Finished(Draft& draft) {
  return Finished(world::PlanOf(world::Surveyed(draft.sketch, draft.rng)), draft);
}

world::BoxPlan Box(const std::string& material, const Vector2d& at, double yaw_deg, const Vector2d& size) {
  return {material, at.x(), at.y(), yaw_deg, size.x(), size.y(), 1.9, 0, material};
}

void Nothing(Draft&) {}

void AddBox(Draft& draft) {
  const Vector2d at(draft.rng.Uniform(3.6, 5.2), kWidth_m / 2 + draft.rng.Uniform(-0.3, 0.3));
  draft.world.boxes.push_back(Box("cardboard", at, draft.rng.Uniform(-45, 45), {0.35, 0.35}));
}

/// Five posts around the way, between any two of which the circle around the base fits.
void AddPosts(Draft& draft) {
  constexpr double kApart_m = 1.5;
  for (int tries = 0; tries < 200 && draft.world.boxes.size() < 5; ++tries) {
    const Vector2d at(draft.rng.Uniform(2.6, 6.4), draft.rng.Uniform(1.9, 4.1));
    const double size_m = draft.rng.Uniform(0.04, 0.15);
    const auto near = [&](const world::BoxPlan& other) {
      return (at - Vector2d(other.x_m, other.y_m)).norm() < kApart_m;
    };
    if (std::any_of(draft.world.boxes.begin(), draft.world.boxes.end(), near)) continue;
    draft.world.boxes.push_back(Box("metal", at, draft.rng.Uniform(0, 90), {size_m, size_m}));
  }
}

/// A wall across with an opening in it, askew and beside the line from start to goal.
void AddOpening(Draft& draft) {
  const Pose2 middle{4.4, kWidth_m / 2 + draft.rng.Uniform(-0.3, 0.3), Radians(draft.rng.Uniform(-25, 25))};
  const double half_m = draft.rng.Uniform(0.9, 1.5) / 2;
  const double slope = std::cos(middle.yaw);
  const auto end = [&](double y_m) { return middle * Vector2d(0, (y_m - middle.y) / slope); };
  draft.sketch.walls.push_back({"right", end(-world::kHalfWall_m), middle * Vector2d(0, -half_m), {}});
  draft.sketch.walls.push_back(
      {"left", middle * Vector2d(0, half_m), end(kWidth_m + world::kHalfWall_m), {}});
  // A planner that goes by the plan alone knows the opening about as well as this.
  const Pose2 believed = middle * Pose2{0, draft.rng.Uniform(-0.05, 0.05), Radians(draft.rng.Uniform(-2, 2))};
  draft.instead = {believed * Pose2{-1.2, 0, 0}, believed * Pose2{1.2, 0, 0}};
}

/// A thing across the hall from wall to wall, and the way that it leaves, between `low_m` and `high_m`
/// across.
void AddAcross(Draft& draft, const Pose2& middle, double low_m, double high_m) {
  static const std::vector<std::string> kMaterials{"wood", "plaster", "cardboard"};
  const std::string& material = kMaterials.at(draft.rng.Below(kMaterials.size()));
  const double thick_m = draft.rng.Uniform(0.05, 0.3), slope = std::cos(middle.yaw);
  const auto add = [&](double from_m, double to_m) {
    if (to_m - from_m < thick_m) return;
    const Vector2d at = middle * Vector2d(0, ((from_m + to_m) / 2 - middle.y) / slope);
    draft.world.boxes.push_back(Box(material, at, Degrees(middle.yaw), {thick_m, (to_m - from_m) / slope}));
  };
  add(0.05, low_m);
  add(high_m, kWidth_m - 0.05);
}

/// Ways of 1.1 to 1.3 m beside things that reach across the hall: along its wall, beside the line to the
/// goal, or two of these in turns.
void AddWays(Draft& draft) {
  const auto kind = draft.rng.Below(3);
  const double side = draft.rng.Chance(0.5) ? 1 : -1, wide_m = draft.rng.Uniform(1.1, 1.3);
  const double line_m = kind == 0 ? kWidth_m / 2 + side * draft.rng.Uniform(0.9, 1.4) : draft.start.y;
  draft.start.y = draft.goal.y = line_m;
  const auto across = [&](double x_m, double beside_m) {
    const Pose2 middle{x_m, line_m, Radians(draft.rng.Uniform(-8, 8))};
    AddAcross(draft, middle, line_m + beside_m - wide_m / 2, line_m + beside_m + wide_m / 2);
  };
  const double x_m = draft.rng.Uniform(3.6, 4.4), beside_m = side * draft.rng.Uniform(0.2, 1.2);
  if (kind == 0) across(x_m, (kWidth_m + side * (kWidth_m - wide_m)) / 2 - line_m);
  if (kind > 0) across(x_m, beside_m);
  if (kind == 2) across(x_m + draft.rng.Uniform(2.0, 2.4), -beside_m);
}

/// A smooth partition that leans into the way: its far end reaches across the middle of it.
void AddPartition(Draft& draft) {
  constexpr double kLong_m = 2.5;
  const double side = draft.rng.Chance(0.5) ? 1 : -1;
  const double angle = -side * Radians(draft.rng.Uniform(10, 35));
  const Vector2d far(draft.rng.Uniform(4.8, 5.8), kWidth_m / 2 - side * draft.rng.Uniform(-0.2, 0.3));
  const Vector2d along(std::cos(angle), std::sin(angle));
  draft.world.boxes.push_back(Box("metal", far - kLong_m / 2 * along, Degrees(angle), {kLong_m, 0.04}));
}

void AddClutter(Draft& draft) {
  static const std::vector<std::string> kKinds{"carton", "cupboard", "bin", "post"};
  const auto any = [](const Vector2d&, double) { return true; };
  const world::Ground ground{{2.0, 0.1}, {7.0, kWidth_m - 0.1}};
  do {
    draft.world.boxes.clear();
    const int count = 8 + int(draft.rng.Below(7));
    for (int i = 0; i < count; ++i) {
      const std::string& kind = kKinds.at(draft.rng.Below(kKinds.size()));
      world::BoxPlan thing = world::DrawThing(kind, draft.rng);
      thing.height_m = std::max(thing.height_m, kHeard_m);
      if (world::PlaceThing(ground, any, draft.world, draft.rng, thing)) draft.world.boxes.push_back(thing);
    }
  } while (!CircleFits(draft.Solids(), draft.start, draft.goal, kCircleBeside_m));
}

/// Somebody who walks to and fro across the way; every other one does not look.
void AddPerson(Draft& draft) {
  const double x_m = draft.rng.Uniform(3.5, 5.5), slant_m = draft.rng.Uniform(-0.8, 0.8);
  world::PersonPlan person;
  person.speed_m_s = draft.rng.Uniform(0.5, 1.2);
  person.start_s = draft.rng.Uniform(0, 10);
  person.attentive = draft.rng.Chance(0.5);
  person.waypoints = {{x_m - slant_m, 0.6, 1, 1}, {x_m + slant_m, kWidth_m - 0.6, 1, 1}};
  draft.world.people.push_back(person);
}

/// Somebody who does not look comes from the side at any slant and, were the base never to slow down, would
/// walk into its outline between front and rear corner. He comes once.
void AddCrossing(Draft& draft) {
  constexpr double kSetsOff_s = 1.5, kBeside_m = 0.6, kFarthest_m = 2.0, kGone_s = 3600;
  const double x_m = draft.rng.Uniform(3.2, 5.6), side = draft.rng.Chance(0.5) ? 1 : -1;
  const double slant = Radians(draft.rng.Uniform(-45, 45));  // positive: from ahead
  // Two of three before the front corner: beside the flank it is he who walks into the base.
  const double ahead_m =
      draft.rng.Chance(2.0 / 3) ? draft.rng.Uniform(0.3, 0.8) : draft.rng.Uniform(-0.5, 0.3);
  const Vector2d at(x_m + ahead_m, draft.start.y);
  const Vector2d from_there(std::sin(slant), side * std::cos(slant));
  world::PersonPlan person;
  person.speed_m_s = draft.rng.Uniform(0.3, 1.2);
  person.attentive = false;
  person.start_s = std::max(0.0, kSetsOff_s + (x_m - draft.start.x) / kPathSpeed_m_s -
                                     (kFarthest_m - kBeside_m) / std::cos(slant) / person.speed_m_s);
  const Vector2d from = at + kFarthest_m / std::cos(slant) * from_there,
                 to = at - kFarthest_m / std::cos(slant) * from_there;
  person.waypoints = {{from.x(), from.y(), kGone_s, 0}, {to.x(), to.y(), kGone_s, 0}};
  draft.world.people.push_back(person);
}

/// The lane of scenario detour up to a metre before its door; the start is known.
Case ShippedDetour(std::uint64_t seed, const std::string& deployment) {
  const auto resolve = [&](const std::string& name) { return deployment + "/" + name; };
  const world::LoadedWorld world =
      world::LoadWorld("worlds/door-detour.toml", resolve, world::BodyOf({}), seed);
  return {world.solids, world.hazards, OrderBy(world.map, world.start.truth, {5.0, 2.4, 0})};
}

/// The first metres of a corridor of `priamos world generate`, with whoever walks there.
Case GeneratedCorridor(std::uint64_t seed) {
  const world::GeneratedWorld made = world::Generate("corridor", seed);
  Draft draft(seed, "corridor");
  draft.world = world::OfTheDay(made.world, seed);
  draft.start = world::DrawStart(draft.world.start, seed).nominal;
  const Vector2d ahead = made.corridor_end.value().translation() - draft.start.translation();
  const Vector2d to = draft.start.translation() + std::min(1.0, kFollowed_m / ahead.norm()) * ahead;
  draft.goal = {to.x(), to.y(), std::atan2(ahead.y(), ahead.x())};
  Case out{
      world::BuildSolids(made.truth, draft.world, seed), {}, OrderBy(made.surveyed, draft.start, draft.goal)};
  for (const world::PersonPlan& person : draft.world.people)
    out.hazards.people.push_back(world::DrawPerson(person, seed));
  return out;
}

const std::map<std::string, void (*)(Draft&)>& Makers() {
  static const std::map<std::string, void (*)(Draft&)> makers{
      {"free", Nothing},       {"box", AddBox},       {"posts", AddPosts},
      {"opening", AddOpening}, {"ways", AddWays},     {"partition", AddPartition},
      {"clutter", AddClutter}, {"person", AddPerson}, {"crossing", AddCrossing}};
  return makers;
}

Case Made(const std::string& family, std::uint64_t seed, const std::string& deployment) {
  if (family == "detour") return ShippedDetour(seed, deployment);
  if (family == "corridor") return GeneratedCorridor(seed);
  const auto maker = Makers().find(family);
  if (maker == Makers().end()) throw std::invalid_argument("no family \"" + family + "\"");
  Draft draft(seed, family);
  maker->second(draft);
  return Finished(draft);
}

}  // namespace

const std::vector<Family>& Families() {
  static const std::vector<Family> families{
      {"free", "a hall of 9 x 6 m, 6.4 m to drive"},
      {"box", "the same, a carton of 35 cm on the way"},
      {"posts", "five metal posts of 4 to 15 cm around the way"},
      {"opening", "a wall across, an opening of 0.9 to 1.5 m, up to 25 degrees askew"},
      {"ways", "things across that leave ways of 1.1 to 1.3 m, one or two in turns"},
      {"partition", "a smooth metal partition that leans into the way at 10 to 35 degrees"},
      {"clutter", "8 to 14 cartons, cupboards, bins and posts; the circle around the base gets through"},
      {"person", "somebody walks across to and fro, 0.5 to 1.2 m/s, every other one does not look"},
      {"crossing",
       "somebody who does not look comes from the side, 0.3 to 1.2 m/s, once, and would meet the base"},
      {"detour", "the lane of scenario detour, as shipped, to 1 m before its door"},
      {"corridor", "8 m of a corridor of `priamos world generate`, with clutter and people"}};
  return families;
}

Case MakeCase(const std::string& family, std::uint64_t seed, const std::string& deployment) {
  Case made = Made(family, seed, deployment);
  Vector2d from = made.order.start.translation();
  for (const Pose2& to : made.order.path.points) {
    made.length_m += (to.translation() - from).norm();
    from = to.translation();
  }
  made.solids = world::WithPeople(made.solids, made.hazards.people);
  return made;
}

}  // namespace priamos::bench
