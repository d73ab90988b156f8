#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "world/core/render/lighting.hpp"
#include "world/core/render/textures.hpp"
#include "world/core/scene/placed_reference.hpp"
#include "world/core/scene/scene.hpp"
#include "world/core/scene/solid.hpp"

namespace priamos::world {

/// A corner of a triangle, as the graphics memory holds it.
struct MeshVertex {
  float x, y, z;      ///< map
  float u, v, layer;  ///< place in the textures
  float light;        ///< on this point of the surface, 1 is the most
  float retro;        ///< share of the camera light that returns to the camera
  float laser;        ///< light of the laser line
};

/// Triangles, three vertices each, counter-clockwise seen from outside.
using Mesh = std::vector<std::array<MeshVertex, 3>>;

/// Appends a solid to a mesh. `most_light` is the value of Lighting that becomes 1 in the mesh.
void AppendSolid(const Solid& solid, const Surface& surface, const Lighting& lighting, double most_light,
                 Mesh& mesh);
/// Floor and ceiling.
void AppendRoom(const SceneConfig& config, const Textures& textures, const Lighting& lighting,
                double most_light, Mesh& mesh);
/// The calibration body: black blocks, set back behind their discs by kDiscThickness_m, which are exact.
void AppendReference(const PlacedReference& reference, Mesh& mesh);
inline constexpr double kDiscThickness_m = 0.0005;

}  // namespace priamos::world
