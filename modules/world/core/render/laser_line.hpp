#pragma once

#include "common/geometry.hpp"
#include "world/core/render/laser.hpp"
#include "world/core/render/lighting.hpp"
#include "world/core/render/mesh.hpp"

namespace priamos::world {

/// Adds the line as thin strips on every surface that the light reaches; what stands in the light has a
/// shadow. Glass lets it through; on a mirror there is none.
void AppendLaser(const LaserBuild& laser, const Pose2& map_from_base, const Lighting& surfaces, Mesh& mesh);

}  // namespace priamos::world
