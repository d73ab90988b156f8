#include "world/core/render/mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace priamos::world {
namespace {

constexpr double kFrameTop_m = 2.06, kProud_m = 0.015;

/// A wall along y from 0 to 3 m, its front at x = -0.07, and beside its end at y = 0 a jamb that stands
/// before it.
const std::vector<Solid> kWallAndJamb = {
    {"wall", {0, 1.5, 0}, {0.14, 3}, 0, 2.8, "plaster"},
    {"jamb", {0, -0.03, 0}, {0.14 + 2 * kProud_m, 0.06}, 0, kFrameTop_m, "door_frame"}};

SceneConfig Ambient() {
  SceneConfig config;
  config.ambient = 1;
  config.window = 0;
  return config;
}

/// Light on the front of the wall by its distance from the jamb and its height, between the corners of the
/// mesh; 1e9 where the mesh has none so near.
class FrontOfWall {
 public:
  FrontOfWall() {
    const Lighting lighting(Ambient(), kWallAndJamb);
    AppendSolid(kWallAndJamb[0], Surface{}, lighting, 1.6, mesh_);
  }
  /// The corner nearest to a place.
  MeshVertex Near(double y, double z) const {
    std::optional<MeshVertex> best;
    const auto off = [&](const MeshVertex& v) { return std::hypot(v.y - y, v.z - z); };
    for (const auto& triangle : mesh_)
      for (const MeshVertex& v : triangle)
        if (std::abs(v.x + 0.07) < 1e-6 && (!best || off(v) < off(*best))) best = v;
    return *best;
  }

 private:
  Mesh mesh_;
};

TEST(Mesh, AJambShadesTheWallBesideItWithinAboutItsOwnDepth) {
  const FrontOfWall dut;
  const double beside = dut.Near(0.08, 1).light;
  EXPECT_LT(dut.Near(0, 1).light, 0.8 * beside);
  EXPECT_LT(dut.Near(0.016, 1).light, beside);
  EXPECT_GT(dut.Near(0.016, 1).light, dut.Near(0, 1).light);
  EXPECT_GT(dut.Near(0.03, 1).light, 0.93 * beside);
  EXPECT_LT(dut.Near(0.03, 1).y, 0.04) << "corners lie near the jamb";
}

TEST(Mesh, WhereTheJambEndsItsShadowDoes) {
  const FrontOfWall dut;
  const MeshVertex above = dut.Near(0, kFrameTop_m + 0.05), below = dut.Near(0, kFrameTop_m - 0.05);
  EXPECT_LT(above.z, kFrameTop_m + 0.1);
  EXPECT_GT(above.z, kFrameTop_m);
  EXPECT_NEAR(above.light, dut.Near(0.08, kFrameTop_m + 0.05).light, 0.05);
  EXPECT_LT(below.light, 0.93 * above.light);
}

}  // namespace
}  // namespace priamos::world
