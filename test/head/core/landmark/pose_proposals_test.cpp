#include "head/core/landmark/pose_proposals.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>

#include "test/support/generated_numbers.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d;
using support::Between;

const Eigen::Matrix3d kWide = Eigen::Vector3d(0.1 * 0.1, 0.1 * 0.1, 0.05 * 0.05).asDiagonal();
const Pose2 kTruth{3.2, 0.1, 0.05};

/// Upright edges at these places of the landmark, from the floor to 2 m.
LandmarkModel Uprights(const std::vector<Vector2d>& places) {
  LandmarkModel model;
  for (const Vector2d& at : places)
    model.edges.push_back({.from = {at.x(), at.y(), 0}, .to = {at.x(), at.y(), 2}});
  return model;
}

/// What stereo would make of them at a pose, each from image lines of its own.
std::vector<VerticalEdge> Seen(const LandmarkModel& model, const Pose2& base_from_landmark) {
  std::vector<VerticalEdge> seen;
  for (const LandmarkEdge& edge : model.edges) {
    const int i = static_cast<int>(seen.size());
    seen.push_back({.at = base_from_landmark * Vector2d(edge.from.head<2>()),
                    .covariance = 1e-6 * Eigen::Matrix2d::Identity(),
                    .z_min_m = 0.5,
                    .z_max_m = 1.8,
                    .left = i,
                    .right = i});
  }
  return seen;
}

class PoseProposalsTest : public testing::Test {
 protected:
  Proposals Propose(const Pose2& predicted = kTruth) const {
    std::vector<int> visible(model_.edges.size());
    std::iota(visible.begin(), visible.end(), 0);
    return ProposePoses(model_, visible, verticals_, predicted, kWide, options_);
  }

  LandmarkModel model_ = Uprights({{0, 0.5}, {0, -0.4}, {0.3, 0.1}});
  std::vector<VerticalEdge> verticals_ = Seen(model_, kTruth);
  ProposalOptions options_;
};

double Apart(const Pose2& a, const Pose2& b) {
  return (a.translation() - b.translation()).norm() + std::abs(WrapAngle(a.yaw - b.yaw));
}

TEST_F(PoseProposalsTest, EveryPairOfEdgesSpeaksForTheTruePose) {
  const Proposals dut = Propose({3.25, 0.05, 0.03});
  ASSERT_EQ(dut.poses.size(), 1u);
  EXPECT_EQ(dut.poses[0].support, 3) << "three edges make three pairs";
  EXPECT_EQ(dut.n_tested, 3);
  EXPECT_LT(Apart(dut.poses[0].base_from_landmark, kTruth), 1e-9);
}

RC_GTEST_FIXTURE_PROP(PoseProposalsTest, ThePoseIsFoundWhereverItIsNearThePrediction, ()) {
  const Pose2 truth{Between(-5, 5), Between(-5, 5), Between(-kPi, kPi)};
  verticals_ = Seen(model_, truth);
  const Proposals dut =
      Propose({truth.x + Between(-0.1, 0.1), truth.y + Between(-0.1, 0.1), truth.yaw + Between(-0.05, 0.05)});
  RC_ASSERT(!dut.poses.empty());
  RC_ASSERT(Apart(dut.poses[0].base_from_landmark, truth) < 1e-6);
}

TEST_F(PoseProposalsTest, ThePredictionAndItsCovarianceLimitTheSearch) {
  options_.gate = 2;
  EXPECT_FALSE(Propose({3.2 + 0.19, 0.1, 0.05}).poses.empty());
  EXPECT_TRUE(Propose({3.2 + 0.21, 0.1, 0.05}).poses.empty());
  EXPECT_FALSE(Propose({3.2, 0.1, 0.05 + 0.099}).poses.empty());
  EXPECT_TRUE(Propose({3.2, 0.1, 0.05 + 0.101}).poses.empty());
}

TEST_F(PoseProposalsTest, TheDistanceOfBothEdgesMustFit) {
  model_ = Uprights({{0, 0.5}, {0, -0.4}});
  verticals_ = Seen(model_, {3, 0, 0});
  verticals_[0].at.y() += 0.029;
  EXPECT_EQ(Propose({3, 0, 0}).poses.size(), 1u);
  verticals_[0].at.y() += 0.01;
  EXPECT_TRUE(Propose({3, 0, 0}).poses.empty());
  for (VerticalEdge& v : verticals_) v.covariance = 0.01 * 0.01 * Eigen::Matrix2d::Identity();
  EXPECT_EQ(Propose({3, 0, 0}).poses.size(), 1u)
      << "3 sigma of 14 mm are more than the 9 mm beyond the limit";
}

TEST_F(PoseProposalsTest, AMisfitIsSharedByBothEnds) {
  model_ = Uprights({{0, 0.5}, {0, -0.5}});
  verticals_ = Seen(model_, {3, 0, 0});
  verticals_[0].at.y() += 0.02;
  const Proposals dut = Propose({3, 0, 0});
  ASSERT_EQ(dut.poses.size(), 1u);
  EXPECT_LT(Apart(dut.poses[0].base_from_landmark, {3, 0.01, 0}), 1e-9);
}

TEST_F(PoseProposalsTest, EdgesNearToEachOtherGiveNoDirection) {
  model_ = Uprights({{0, 0.02}, {0, -0.02}});
  verticals_ = Seen(model_, kTruth);
  EXPECT_TRUE(Propose().poses.empty());
  options_.min_base_m = 0.03;
  EXPECT_FALSE(Propose().poses.empty());
}

TEST_F(PoseProposalsTest, OneImageEdgeIsNotTwoEdgesOfTheModel) {
  verticals_[1].left = verticals_[0].left;
  EXPECT_EQ(Propose().n_tested, 2);
  verticals_[2].right = verticals_[0].right;
  EXPECT_EQ(Propose().n_tested, 1);
}

TEST_F(PoseProposalsTest, HeightsMustBeThoseOfTheModel) {
  for (VerticalEdge& v : verticals_) {
    v.z_min_m = 1.9;
    v.z_max_m = 2.15;
  }
  EXPECT_TRUE(Propose().poses.empty()) << "0.1 of 0.25 m is less than half";
  for (VerticalEdge& v : verticals_) v.z_min_m = 1.8;
  EXPECT_EQ(Propose().n_tested, 3);
}

TEST_F(PoseProposalsTest, OnlyVisibleUprightEdgesCount) {
  EXPECT_EQ(ProposePoses(model_, std::vector<int>{0, 2}, verticals_, kTruth, kWide, {}).n_tested, 1);
  EXPECT_TRUE(ProposePoses(model_, std::vector<int>{1}, verticals_, kTruth, kWide, {}).poses.empty());
  for (LandmarkEdge& edge : model_.edges) edge.to = edge.from + Eigen::Vector3d(0, 1, 0);
  EXPECT_TRUE(Propose().poses.empty());
}

TEST_F(PoseProposalsTest, TheMostSupportedComesFirstAndTheRestIsLeftOut) {
  // The same places seen twice, the second time 5 cm to the left and without the third edge.
  const auto again = Seen(model_, {kTruth.x, kTruth.y + 0.05, kTruth.yaw});
  for (int i = 0; i < 2; ++i) {
    verticals_.push_back(again[i]);
    verticals_.back().left = verticals_.back().right = 10 + i;
  }
  const Proposals dut = Propose();
  ASSERT_GE(dut.poses.size(), 2u);
  EXPECT_EQ(dut.poses[0].support, 3);
  EXPECT_LT(Apart(dut.poses[0].base_from_landmark, kTruth), 1e-6);
  int sum = 0;
  for (std::size_t i = 0; i < dut.poses.size(); ++i) {
    sum += dut.poses[i].support;
    if (i > 0) {
      EXPECT_LE(dut.poses[i].support, dut.poses[i - 1].support);
    }
  }
  EXPECT_EQ(sum, dut.n_tested) << "every chance is counted in one pose";
  options_.max_proposals = 1;
  const Proposals best = Propose();
  ASSERT_EQ(best.poses.size(), 1u);
  EXPECT_EQ(best.poses[0].support, 3);
  EXPECT_EQ(best.n_tested, dut.n_tested);
}

TEST_F(PoseProposalsTest, PosesThatHardlyDifferAreOne) {
  verticals_[2].at.x() += 0.02;
  options_.merge_m = 0.001;
  options_.merge_rad = 0.001;
  EXPECT_EQ(Propose().poses.size(), 3u);
  options_.merge_m = options_.merge_rad = 0.1;
  EXPECT_EQ(Propose().poses.size(), 1u);
}

TEST_F(PoseProposalsTest, ALineBesideTheRightOneIsAnotherPose) {
  // All three edges once more, 12 mm to the side, as the frames of doors beside the arrises of a cupboard.
  const auto twins = Seen(model_, {kTruth.x, kTruth.y + 0.012, kTruth.yaw});
  for (int i = 0; i < 3; ++i) {
    verticals_.push_back(twins[i]);
    verticals_.back().left = verticals_.back().right = 10 + i;
  }
  const Proposals dut = Propose();
  for (const double aside_m : {0.0, 0.012}) {
    const Pose2 wanted{kTruth.x, kTruth.y + aside_m, kTruth.yaw};
    EXPECT_TRUE(std::any_of(dut.poses.begin(), dut.poses.end(), [&](const PoseProposal& p) {
      return Apart(p.base_from_landmark, wanted) < 0.005;
    })) << aside_m;
  }
}

TEST_F(PoseProposalsTest, NothingSeenNothingProposed) {
  verticals_.clear();
  EXPECT_TRUE(Propose().poses.empty());
  EXPECT_EQ(Propose().n_tested, 0);
}

TEST(SquaredDistanceTest, CountsInUnitsOfSigma) {
  EXPECT_NEAR(SquaredDistance({1, 2, 0.1}, {1.1, 1.8, 0.1}, kWide), 1 + 4, 1e-9);
  EXPECT_NEAR(SquaredDistance({1, 2, 0.1}, {1, 2, 0.2}, kWide), 4, 1e-9);
  EXPECT_NEAR(SquaredDistance({0, 0, kPi - 0.02}, {0, 0, -kPi + 0.03}, kWide), 1, 1e-9) << "across +-pi";
}

TEST(SquaredDistanceTest, KnowsCorrelations) {
  Eigen::Matrix3d covariance = kWide;
  covariance(0, 1) = covariance(1, 0) = 0.9 * 0.01;
  // Along the correlation sigma^2 is 0.01 (1 + 0.9), across it 0.01 (1 - 0.9).
  EXPECT_NEAR(SquaredDistance({0.1, 0.1, 0}, {}, covariance), 0.02 / 0.019, 1e-9);
  EXPECT_NEAR(SquaredDistance({0.1, -0.1, 0}, {}, covariance), 0.02 / 0.001, 1e-9);
}

}  // namespace
}  // namespace priamos::head
