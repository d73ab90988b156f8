#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/archive.hpp"
#include "common/input/section_place.hpp"

namespace priamos::world {

/// A place that a person walks to.
struct PersonStop {
  double x_m = 0, y_m = 0;    ///< map
  double pause_s = 0;         ///< how long the person stands there ...
  double pause_spread_s = 0;  ///< ... off by up to this, drawn anew every time

  void Describe(Archive& a);
};

/// A person who walks from waypoint to waypoint, for ever, and stands a while at each. One waypoint: a person
/// who stands there.
struct PersonPlan {
  std::string name = "person";
  double speed_m_s = 0.8, speed_spread_m_s = 0;
  double spread_m = 0;    ///< every waypoint is off by up to this along each axis
  double chance = 1;      ///< the person is there in this part of the runs
  double start_s = 0;     ///< the person stands at the first waypoint until then
  bool attentive = true;  ///< walks around the robot, or stops before it; otherwise walks into it
  std::vector<PersonStop> waypoints;
  SectionPlace place;  ///< where it was read, for errors

  void Describe(Archive& a);
};

/// A person of this run: speed and waypoints drawn from the seed and the person's name.
PersonPlan DrawPerson(PersonPlan plan, std::uint64_t seed);

}  // namespace priamos::world
