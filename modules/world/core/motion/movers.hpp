#pragma once

#include <cstdint>
#include <vector>

#include "world/core/motion/person.hpp"
#include "world/core/motion/swinging_leaf.hpp"
#include "world/core/scene/moved_solid.hpp"

namespace priamos::world {

/// `solids`, and after them those of the people at their first waypoints.
std::vector<Solid> WithPeople(std::vector<Solid> solids, const std::vector<PersonPlan>& people);

/// Everything that moves by itself: people, and leaves that are moved.
class Movers {
 public:
  /// `solids` are those of WithPeople. A leaf whose solid is not among them throws std::invalid_argument.
  Movers(const std::vector<PersonPlan>& people, const std::vector<MovedLeaf>& leaves,
         const std::vector<Solid>& solids, std::uint64_t seed);

  bool empty() const { return moved_.empty(); }
  void Step(double since_start_s, double dt_s, const Rectangle& robot);
  /// Where all of them are: leaves first, then the parts of the people.
  const std::vector<MovedSolid>& moved() const { return moved_; }
  const std::vector<Person>& people() const { return people_; }
  const std::vector<SwingingLeaf>& leaves() const { return leaves_; }

 private:
  void Update();

  std::vector<SwingingLeaf> leaves_;
  std::vector<Person> people_;
  std::vector<MovedSolid> moved_;
  Around around_;
  std::size_t fixed_walls_ = 0;  ///< of around_.walls; the others are the leaves
};

}  // namespace priamos::world
