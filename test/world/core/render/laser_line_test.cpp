#include "world/core/render/laser_line.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace priamos::world {
namespace {

using Eigen::Vector3d;

Vector3d Middle(const std::array<MeshVertex, 3>& t) {
  Vector3d sum = Vector3d::Zero();
  for (const MeshVertex& v : t) sum += Vector3d(v.x, v.y, v.z);
  return sum / 3;
}

Mesh Line(const std::vector<Solid>& solids, const Pose2& map_from_base = {}) {
  Mesh mesh;
  AppendLaser(LaserBuild{}, map_from_base, Lighting(SceneConfig{}, solids), mesh);
  return mesh;
}

TEST(LaserLine, DrawsAStraightLineOnTheFloor) {
  const LaserBuild build;
  const double expected_x = build.x_m + build.z_m / std::tan(build.pitch_rad);
  for (const auto& t : Line({})) {
    EXPECT_NEAR(Middle(t).z(), 0, 0.001);
    EXPECT_NEAR(Middle(t).x(), expected_x, 0.01) << "a level fan draws a line across";
  }
}

TEST(LaserLine, EveryPointLiesInThePlaneOfTheLight) {
  const std::vector<Solid> box = {{"box", {1.8, 0.1, 0.3}, {0.3, 0.4}, 0, 0.2, "cardboard"}};
  const Pose2 map_from_base{0.3, -0.2, 0.1};
  const Mesh mesh = Line(box, map_from_base);
  ASSERT_GT(mesh.size(), 100U);
  for (const auto& t : mesh) {
    for (const MeshVertex& v : t) {
      const Eigen::Vector2d in_base = map_from_base.Inverse() * Eigen::Vector2d(v.x, v.y);
      const double off = LaserBuild{}.Plane().absDistance({in_base.x(), in_base.y(), v.z});
      EXPECT_NEAR(off, LaserBuild{}.thickness_m / 2, 0.0003);
    }
  }
}

TEST(LaserLine, AnObstacleLiftsTheLineAndShadesTheFloor) {
  const std::vector<Solid> box = {{"box", {1.8, 0, 0}, {0.2, 0.4}, 0, 0.2, "cardboard"}};
  int on_box = 0;
  for (const auto& t : Line(box)) {
    const Vector3d p = Middle(t);
    if (std::abs(p.y()) < 0.19) {
      EXPECT_GT(p.z(), 0.01) << "no line behind the box";
      ++on_box;
    }
  }
  EXPECT_GT(on_box, 50);
}

TEST(LaserLine, TrianglesFaceTheLight) {
  const std::vector<Solid> box = {{"box", {1.8, 0, 0}, {0.2, 0.4}, 0, 0.2, "cardboard"}};
  const Vector3d laser(LaserBuild{}.x_m, 0, LaserBuild{}.z_m);
  for (const auto& t : Line(box)) {
    const auto p = [&](int i) { return Vector3d(t[i].x, t[i].y, t[i].z); };
    const Vector3d normal = (p(1) - p(0)).cross(p(2) - p(0));
    EXPECT_GT(normal.dot(laser - p(0)), 0);
  }
}

/// Whether any part of the line is near that place of the floor.
bool Shines(const Mesh& mesh, double x, double y) {
  for (const auto& t : mesh) {
    const Vector3d p = Middle(t);
    if (std::hypot(p.x() - x, p.y() - y) < 0.05 && std::abs(p.z()) < 0.01) return true;
  }
  return false;
}

TEST(LaserLine, GlassLetsItThroughAndAMirrorShowsNone) {
  const Vector3d on_floor = Middle(Line({}).at(Line({}).size() / 2));
  const auto pane = [](const std::string& material) {
    return std::vector<Solid>{{"pane", {1.0, 0, 0}, {0.02, 4}, 0, 2, material}};
  };
  EXPECT_TRUE(Shines(Line(pane("glass")), on_floor.x(), on_floor.y()));
  EXPECT_TRUE(Line(pane("mirror")).empty());
  EXPECT_FALSE(Line(pane("plaster")).empty());
}

TEST(LaserLine, OverAHoleTheFloorIsMissing) {
  const Vector3d on_floor = Middle(Line({}).at(Line({}).size() / 2));
  HolePlan hole;
  hole.x_m = on_floor.x();
  hole.length_m = 0.6;
  hole.width_m = 4;
  hole.depth_m = 1;
  SceneConfig config;
  config.holes = {hole};
  Mesh mesh;
  AppendLaser(LaserBuild{}, {}, Lighting(config, {}), mesh);
  EXPECT_FALSE(Shines(mesh, on_floor.x(), on_floor.y()));
}

}  // namespace
}  // namespace priamos::world
