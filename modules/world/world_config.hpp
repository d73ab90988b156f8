#pragma once

#include <string>
#include <vector>

#include "common/archive.hpp"
#include "world/core/camera/imaging.hpp"
#include "world/core/camera/optics.hpp"
#include "world/core/render/laser.hpp"
#include "world/core/simulation.hpp"

namespace priamos::world {

/// Contents of `config/<deployment>/world.toml`: the simulated robot, and which world it is put into.
struct WorldConfig {
  std::string world = "worlds/door.toml";
  RobotModel robot;
  ImagingConfig lens;
  int head_specimen = 1;
  HeadBuild head;
  std::vector<LaserBuild> lasers = ShippedLasers();

  void Describe(Archive& a);
  /// The head as built: the specimen, or `head` when that is 0.
  HeadBuild BuiltHead() const;
};

}  // namespace priamos::world
