#include "head/core/stand/level_directions.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "common/random.hpp"

namespace priamos::head {
namespace {

/// Edges that run along a direction, seen anywhere, with noise.
std::vector<UprightVote> Along(const Eigen::Vector3d& direction, int n, Rng& rng, double noise_rad = 5e-4) {
  std::vector<UprightVote> votes;
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d sight(rng.Uniform(-0.5, 0.5), rng.Uniform(-0.4, 0.4), 1);
    UprightVote vote;
    vote.normal = (sight.cross(direction).normalized() +
                   noise_rad * Eigen::Vector3d(rng.Normal(1), rng.Normal(1), rng.Normal(1)))
                      .normalized();
    vote.noise = {direction * noise_rad, Eigen::Vector3d::Zero()};
    vote.weight = 60;
    votes.push_back(vote);
  }
  return votes;
}

class LevelDirectionsTest : public testing::Test {
 protected:
  static double Alike(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return std::abs(a.dot(b)); }

  Rng rng_{4};
  const Eigen::Vector3d up_ = Eigen::Vector3d(0.02, -1, -0.1).normalized();
  const Eigen::Vector3d wall_ = up_.cross(Eigen::Vector3d(0.4, 0, 1)).normalized();
  const Eigen::Vector3d other_ = (up_.cross(wall_) + 0.4 * wall_).normalized();  // no right angle
};

TEST_F(LevelDirectionsTest, TwoWallsAreFoundAtAnyAngleTheHeavierOneFirst) {
  auto edges = Along(wall_, 20, rng_);
  const auto more = Along(other_, 12, rng_);
  edges.insert(edges.end(), more.begin(), more.end());
  const auto dut = FindLevelDirections(edges, up_);
  ASSERT_EQ(dut.size(), 2u);
  EXPECT_GT(Alike(dut[0], wall_), 0.999);
  EXPECT_GT(Alike(dut[1], other_), 0.999);
  EXPECT_TRUE(FindLevelDirections({}, up_).empty());
}

TEST_F(LevelDirectionsTest, LevelEdgesTellTheTiltThatUprightsNextToEachOtherDoNot) {
  const auto steep = Along(up_, 3, rng_, 0.003);
  auto level = Along(wall_, 20, rng_);
  const auto more = Along(other_, 12, rng_);
  level.insert(level.end(), more.begin(), more.end());
  const Eigen::Vector3d start = (up_ + Eigen::Vector3d(0, 0, 0.015)).normalized();
  const LevelFrame dut = FitLevelFrame(steep, level, {start, FindLevelDirections(level, start), {}}, {});
  EXPECT_LT((dut.up - up_).norm(), 0.002);
  EXPECT_GT(dut.n_level, 25);
  ASSERT_EQ(dut.walls.size(), 2u);
  EXPECT_NEAR(dut.walls[0].dot(dut.up), 0, 1e-9);
}

TEST_F(LevelDirectionsTest, WithoutLevelEdgesNothingChanges) {
  const LevelFrame dut = FitLevelFrame(Along(up_, 5, rng_), {}, {up_, {}, {}}, {});
  EXPECT_EQ(dut.up, up_);
  EXPECT_EQ(dut.n_level, 0);
}

}  // namespace
}  // namespace priamos::head
