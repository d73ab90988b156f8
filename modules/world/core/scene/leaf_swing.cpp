#include "world/core/scene/leaf_swing.hpp"

namespace priamos::world {

void LeafSwing::Describe(Archive& a) {
  a.Number("at_s", at_s, {"s", 0, 3600, "when it begins, since the world began"});
  a.Number("to_deg", to_deg, {"deg", 0, 175, "opening angle that the leaf is moved to"});
  a.Number("speed_deg_s", speed_deg_s, {"deg/s", 1, 200, "how fast"});
}

}  // namespace priamos::world
