#include "world/world_config.hpp"

namespace priamos::world {

void WorldConfig::Describe(Archive& a) {
  a.Text("world", world, "world file, relative to the folder of this file");
  a.Integer("head_specimen", head_specimen,
            {"-", 0, 1000000, "draws the manufacturing errors of KASTOR; 0 takes those of [head]"});
  a.Section("robot", robot, "the robot's body and devices");
  a.Section("lens", lens, "lens blur, sensor and noise of the cameras");
  a.Section("head", head, "mechanics and lenses of KASTOR for head_specimen = 0");
  DescribeLasers(a, lasers);
}

HeadBuild WorldConfig::BuiltHead() const {
  return head_specimen == 0 ? head : HeadBuild::Specimen(static_cast<std::uint64_t>(head_specimen));
}

}  // namespace priamos::world
