#include "head/core/bodies/body_proposals.hpp"

#include <gtest/gtest.h>

#include "head/core/bodies/polyhedron.hpp"
#include "head/core/edges/edge_segments.hpp"
#include "test/head/core/bodies/grey_cupboard.hpp"

namespace priamos::head {
namespace {

class BodyProposalsTest : public testing::Test {
 protected:
  BodyProposalsTest() {
    truth_.translation() << 2.6, -0.4, 0.2;
    truth_.rotate(Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ()));
    EdgeOperator().Extract(test::RenderQuads(cupboard_.quads, truth_, camera_, 2, rng_, 60), edges_);
    view_ = MakeView(camera_, edges_);
    seen_ = VisibleSkeleton(cupboard_.body, truth_.inverse() * OpticalCentre(camera_));
  }

  /// Largest distance in the image of a corner at `pose` from where it is.
  double Off(const Eigen::Isometry3d& pose) const {
    double off_px = 0;
    for (const LandmarkEdge& edge : seen_.edges)
      off_px =
          std::max(off_px, (camera_.Project(pose * edge.from) - camera_.Project(truth_ * edge.from)).norm());
    return off_px;
  }

  Rng rng_{5};
  const CameraModel camera_ = test::HeadCamera(0, 1, 700);
  const test::GreyCupboard cupboard_;
  Eigen::Isometry3d truth_ = Eigen::Isometry3d::Identity();
  EdgeImage edges_;
  CameraView view_;
  LandmarkModel seen_;
};

TEST_F(BodyProposalsTest, TheFirstOneIsNearTheTruthFromAnySide) {
  const BodyPrior prior{0.035 * 2.6, 0.03};
  for (const Eigen::Vector3d& side :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 1), Eigen::Vector3d(-1, -1, 0)}) {
    Eigen::Isometry3d believed = truth_;
    believed.pretranslate(Eigen::Vector3d(0.15 * side.normalized()));
    believed.rotate(Eigen::AngleAxisd(0.05, Eigen::Vector3d(1, -1, 2).normalized()));
    ASSERT_GT(Off(believed), 15);
    const auto dut = ProposeBodyPoses(seen_, believed, {&view_, 1}, prior, {});
    ASSERT_FALSE(dut.empty());
    EXPECT_LT(Off(dut.front()), 6) << side.transpose();
  }
}

TEST_F(BodyProposalsTest, TheyAreTheSameEachTimeAndNoMoreThanAskedFor) {
  const BodyPrior prior{0.09, 0.03};
  BodyProposalOptions options;
  options.n_best = 3;
  const auto first = ProposeBodyPoses(seen_, truth_, {&view_, 1}, prior, options);
  const auto again = ProposeBodyPoses(seen_, truth_, {&view_, 1}, prior, options);
  ASSERT_LE(first.size(), 3u);
  ASSERT_EQ(first.size(), again.size());
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_TRUE(first[i].isApprox(again[i], 0)) << i;
}

TEST_F(BodyProposalsTest, WithoutEdgesInTheImageNothingIsBetterThanTheBelief) {
  view_.lines.clear();
  const auto dut = ProposeBodyPoses(seen_, truth_, {&view_, 1}, {0.09, 0.03}, {});
  ASSERT_FALSE(dut.empty());
  EXPECT_TRUE(dut.front().isApprox(truth_));
}

}  // namespace
}  // namespace priamos::head
