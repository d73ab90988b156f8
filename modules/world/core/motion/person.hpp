#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "common/geometry.hpp"
#include "common/random.hpp"
#include "common/rectangle.hpp"
#include "world/core/scene/person_plan.hpp"
#include "world/core/scene/solid.hpp"

namespace priamos::world {

/// How a person stands: the middle of the body, facing along x, and where in a double step the legs are.
struct Posture {
  Pose2 map_from_person;
  double phase_rad = 0;  ///< 0: legs side by side
};

/// The parts of a body: two legs, a trunk, a head, two feet.
inline constexpr std::size_t kBodyParts = 6;

/// Solids of a person: a grown-up of 1.72 m (DIN 33402-2, median), shoulders 46 cm broad. Walking, the legs
/// stand up to 30 cm apart at the height of the sonars, half of what the feet do.
std::array<Solid, kBodyParts> SolidsOf(const std::string& name, const Posture& posture);
/// Where those solids are, map frame.
std::array<Pose2, kBodyParts> PartPoses(const Posture& posture);

/// What a person must not walk through, map frame.
struct Around {
  Rectangle robot;
  std::vector<Rectangle> walls;  ///< everything else between knee and head
};

/// A person who walks from waypoint to waypoint. Ten times a second an attentive person looks one second
/// ahead: if the straight way comes nearer than 60 cm to the robot or 20 cm to a wall, the nearest of 25, 50
/// and 75 degrees to either side that does not is taken; if there is none, the person stands until there is,
/// and after 4 s goes on to the next waypoint. Who stands has the legs side by side. An inattentive person
/// sees walls only, walks into the robot, stands against it for 2 s, and turns back.
class Person {
 public:
  /// Person at the first waypoint of a drawn plan; `rng` draws the pauses.
  Person(PersonPlan plan, Rng rng);

  /// Advances by `dt_s`; the body stops where it would touch `around`.
  void Step(double dt_s, const Around& around);
  const Posture& posture() const { return posture_; }
  const PersonPlan& plan() const { return plan_; }

 private:
  void Decide(const Around& around);
  void GoOn();
  void CloseStep(double dt_s);
  bool FreeAhead(double heading_rad, const Around& around) const;
  void Advance(double dt_s, const Around& around);
  bool AgainstRobot(const Posture& posture, const Around& around) const;
  Eigen::Vector2d Target() const;

  PersonPlan plan_;
  Rng rng_;
  Posture posture_;
  std::size_t next_ = 0;
  bool forward_ = true, walking_ = false;
  double pause_s_ = 0, decide_in_s_ = 0, stood_s_ = 0, held_s_ = 0;
};

}  // namespace priamos::world
