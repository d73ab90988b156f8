#include <gtest/gtest.h>

#include <filesystem>

#include "head/landmark_file.hpp"

namespace priamos::head {
namespace {

const std::filesystem::path kModels = PRIAMOS_SOURCE_DIR "/config/sim/models";

TEST(LandmarkModels, EveryShippedBodyShowsThreeFacesToAnEyeBeforeItsCorner) {
  int n = 0;
  for (const auto& file : std::filesystem::directory_iterator(kModels)) {
    const Polyhedron body = LoadPolyhedron(file.path().string());
    EXPECT_GE(VisibleSkeleton(body, {-1.5, -1.5, 2.5}).edges.size(), 9u) << file.path();
    ++n;
  }
  EXPECT_GE(n, 2);
}

TEST(LandmarkModels, TheCupboardShowsPlinthAndGapFromBeforeOnly) {
  const Polyhedron body = LoadPolyhedron((kModels / "cupboard.toml").string());
  const auto on_front = [&](const Eigen::Vector3d& eye) {
    int n = 0;
    for (const LandmarkEdge& e : VisibleSkeleton(body, eye).edges)
      n += std::abs(e.from.x()) < 1e-9 && std::abs(e.to.x()) < 1e-9 &&
           (std::abs(e.from.y()) < 0.01 || std::abs(e.from.z() - 0.09) < 1e-9);
    return n;
  };
  EXPECT_EQ(on_front({-2.5, 0.3, 1.25}), 3);
  EXPECT_EQ(on_front({2.5, 0.3, 1.25}), 0);
}

}  // namespace
}  // namespace priamos::head
