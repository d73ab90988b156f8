#include <gtest/gtest.h>

#include <filesystem>

#include "head/files/landmark_file.hpp"
#include "test/support/project_files.hpp"

namespace priamos::head {
namespace {

const std::filesystem::path kModels = PRIAMOS_SOURCE_DIR "/config/sim/models";

TEST(LandmarkModels, EveryShippedBodyShowsThreeFacesToAnEyeBeforeItsCorner) {
  int n = 0;
  for (const auto& file : ProjectFiles("config/sim/models")) {
    const Polyhedron body = LoadPolyhedron((PRIAMOS_SOURCE_DIR / file).string());
    EXPECT_GE(VisibleSkeleton(body, {-1.5, -1.5, 2.5}).edges.size(), 9u) << file;
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
