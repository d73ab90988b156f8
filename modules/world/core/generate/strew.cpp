#include "world/core/generate/strew.hpp"

#include <algorithm>

#include "common/random.hpp"
#include "common/sonar_ring.hpp"
#include "world/core/generate/clutter.hpp"

namespace priamos::world {
namespace {

constexpr double kOfPeople_m = 0.35;

/// Draws one number per item, present or not, so that one more item leaves those before it as they were.
template <class Item>
void LeaveOut(std::vector<Item>& items, Rng& rng) {
  std::erase_if(items, [&rng](const Item& item) { return rng.Uniform(0, 1) >= item.chance; });
}

std::vector<Eigen::Vector2d> PlacesOfPeople(const WorldPlan& plan, std::uint64_t seed) {
  std::vector<Eigen::Vector2d> places;
  for (const PersonPlan& person : plan.people)
    for (const PersonStop& stop : DrawPerson(person, seed).waypoints) places.emplace_back(stop.x_m, stop.y_m);
  return places;
}

std::string DrawKind(const std::string& kind, Rng& rng) {
  return kind == "any" ? StrewnKinds().at(rng.Below(StrewnKinds().size())) : kind;
}

void Strew(const StrewnPlan& strewn, const std::vector<Eigen::Vector2d>& people, Rng& rng, WorldPlan& plan) {
  const auto is_free = [&](const Eigen::Vector2d& at, double radius) {
    const auto off_lane = [&](const FreeLane& lane) { return lane.DistanceTo(at) >= radius; };
    const auto off_person = [&](const Eigen::Vector2d& p) { return (p - at).norm() >= radius + kOfPeople_m; };
    return std::all_of(plan.free_lanes.begin(), plan.free_lanes.end(), off_lane) &&
           std::all_of(people.begin(), people.end(), off_person);
  };
  const Ground ground{{strewn.low_m[0], strewn.low_m[1]}, {strewn.high_m[0], strewn.high_m[1]}};
  const auto more = static_cast<std::uint64_t>(strewn.most - strewn.least);
  const int count = strewn.least + static_cast<int>(rng.Below(more + 1));
  for (int i = 0; i < count; ++i) {
    const std::string kind = DrawKind(strewn.kind, rng);
    BoxPlan thing = DrawThing(kind, rng);
    if (PlaceThing(ground, is_free, plan, rng, thing)) AddThing(kind, thing, plan);
  }
}

}  // namespace

WorldPlan OfTheDay(WorldPlan plan, std::uint64_t seed) {
  Rng people = Rng::Stream(seed, "people present"), faults = Rng::Stream(seed, "faults present");
  LeaveOut(plan.people, people);
  LeaveOut(plan.faults.sonars, faults);
  for (SonarFault& fault : plan.faults.sonars)
    if (fault.sensor == SonarFault::kAny) fault.sensor = 1 + static_cast<int>(faults.Below(kSonars));
  const auto places = PlacesOfPeople(plan, seed);
  Rng strewn = Rng::Stream(seed, "strewn");
  for (const StrewnPlan& things : plan.strewn) Strew(things, places, strewn, plan);
  return plan;
}

}  // namespace priamos::world
