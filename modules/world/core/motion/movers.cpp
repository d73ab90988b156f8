#include "world/core/motion/movers.hpp"

#include <algorithm>
#include <stdexcept>

#include "world/core/scene/outline.hpp"

namespace priamos::world {
namespace {

/// People step over what is lower, and do not bump their heads on what is higher.
constexpr double kKnee_m = 0.15, kHead_m = 1.75;

std::size_t IndexOf(const std::string& name, const std::vector<Solid>& solids) {
  const auto it = std::find_if(solids.begin(), solids.end(), [&](const Solid& s) { return s.name == name; });
  if (it == solids.end()) throw std::invalid_argument("no solid named \"" + name + "\"");
  return static_cast<std::size_t>(it - solids.begin());
}

}  // namespace

std::vector<Solid> WithPeople(std::vector<Solid> solids, const std::vector<PersonPlan>& people) {
  for (const PersonPlan& plan : people)
    for (const Solid& part : SolidsOf(plan.name, Person(plan, Rng(0)).posture())) solids.push_back(part);
  return solids;
}

Movers::Movers(const std::vector<PersonPlan>& people, const std::vector<MovedLeaf>& leaves,
               const std::vector<Solid>& solids, std::uint64_t seed) {
  for (const MovedLeaf& leaf : leaves) {
    const std::size_t index = IndexOf(leaf.solid, solids);
    leaves_.emplace_back(leaf, solids[index]);
    moved_.push_back({index, {}});
  }
  const std::size_t first_part = solids.size() - people.size() * kBodyParts;
  for (std::size_t i = 0; i < people.size(); ++i) {
    people_.emplace_back(people[i], Rng::Stream(seed, "pauses of " + people[i].name));
    for (std::size_t k = 0; k < kBodyParts; ++k) moved_.push_back({first_part + i * kBodyParts + k, {}});
  }
  for (std::size_t i = 0; i < first_part; ++i) {
    const bool moves = std::any_of(moved_.begin(), moved_.end(), [&](const auto& m) { return m.solid == i; });
    if (!moves && Overlaps(solids[i], kKnee_m, kHead_m)) around_.walls.push_back(OutlineOf(solids[i]));
  }
  fixed_walls_ = around_.walls.size();
  for (std::size_t i = 0; i < leaves_.size(); ++i)
    around_.walls.push_back(OutlineOf(solids[moved_[i].solid]));
  Update();
}

void Movers::Step(double since_start_s, double dt_s, const Rectangle& robot) {
  if (empty()) return;
  for (SwingingLeaf& leaf : leaves_) leaf.Step(since_start_s, dt_s, robot);
  around_.robot = robot;
  for (Person& person : people_) person.Step(dt_s, around_);
  Update();
}

void Movers::Update() {
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    moved_[i].map_from_solid = leaves_[i].map_from_leaf();
    around_.walls[fixed_walls_ + i].map_from_centre = moved_[i].map_from_solid;
  }
  std::size_t at = leaves_.size();
  for (const Person& person : people_)
    for (const Pose2& part : PartPoses(person.posture())) moved_[at++].map_from_solid = part;
}

}  // namespace priamos::world
