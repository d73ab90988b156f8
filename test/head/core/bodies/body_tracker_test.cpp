#include "head/core/bodies/body_tracker.hpp"

#include <gtest/gtest.h>

#include "head/core/edges/edge_segments.hpp"
#include "test/head/core/bodies/grey_cupboard.hpp"

namespace priamos::head {
namespace {

/// Two cameras before a cupboard, which is moved; nothing else is there.
class BodyTrackerTest : public testing::Test {
 protected:
  FreeModelFix See(const Eigen::Isometry3d& truth) { return Look(cupboard_.quads, truth); }
  FreeModelFix SeeNothing() { return Look(test::WallQuads(), At(30, 0)); }

  static Eigen::Isometry3d At(double y, double yaw) {
    return Eigen::Isometry3d(Eigen::Translation3d(2.6, y, 0.2) *
                             Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
  }
  static double Off(const FreeModelFix& fix, const Eigen::Isometry3d& truth) {
    return (fix.base_from_model.translation() - truth.translation()).norm();
  }

  test::GreyCupboard cupboard_;
  BodyTracker tracker_{cupboard_.body, At(-0.4, 0.3), {}};

 private:
  FreeModelFix Look(const std::vector<test::Quad>& quads, const Eigen::Isometry3d& at) {
    EdgeOperator op;
    op.Extract(test::RenderQuads(quads, at, left_, 2, rng_, 60), edges_[0]);
    op.Extract(test::RenderQuads(quads, at, right_, 2, rng_, 60), edges_[1]);
    const std::vector<CameraView> views{MakeView(left_, edges_[0]), MakeView(right_, edges_[1])};
    return tracker_.Look(views);
  }

  Rng rng_{3};
  const CameraModel left_ = test::HeadCamera(0, 1, 700), right_ = test::HeadCamera(0, -1, 700);
  EdgeImage edges_[2];
};

TEST_F(BodyTrackerTest, FollowsABodyFarBeyondWhereItWasInTheBeginning) {
  for (int i = 0; i <= 10; ++i) {
    const Eigen::Isometry3d truth = At(-0.4 + 0.05 * i, 0.3 + 0.03 * i);
    const FreeModelFix fix = See(truth);
    ASSERT_EQ(fix.verdict, Verdict::kFound) << i << ": " << Describe(fix.verdict);
    EXPECT_LT(Off(fix, truth), 0.01) << i;
    EXPECT_EQ(tracker_.n_lost(), 0);
  }
}

TEST_F(BodyTrackerTest, CountsHowLongItIsLostAndFindsItAgain) {
  ASSERT_EQ(See(At(-0.35, 0.3)).verdict, Verdict::kFound);
  for (int i = 1; i <= 3; ++i) {
    EXPECT_NE(SeeNothing().verdict, Verdict::kFound);
    EXPECT_EQ(tracker_.n_lost(), i);
  }
  const FreeModelFix fix = See(At(-0.2, 0.4));
  EXPECT_EQ(fix.verdict, Verdict::kFound) << Describe(fix.verdict);
  EXPECT_LT(Off(fix, At(-0.2, 0.4)), 0.01);
  EXPECT_EQ(tracker_.n_lost(), 0);
}

TEST_F(BodyTrackerTest, WhatIsLostIsLookedForInTheBeginningToo) {
  for (int i = 0; i <= 10; ++i) See(At(-0.4 + 0.06 * i, 0.3 - 0.03 * i));
  ASSERT_EQ(tracker_.n_lost(), 0);
  EXPECT_NE(SeeNothing().verdict, Verdict::kFound);
  EXPECT_EQ(See(At(-0.4, 0.3)).verdict, Verdict::kFound);
}

TEST_F(BodyTrackerTest, WithoutAnImageItIsLost) {
  EXPECT_EQ(tracker_.Look({}).verdict, Verdict::kNoImage);
  EXPECT_EQ(tracker_.n_lost(), 1);
}

}  // namespace
}  // namespace priamos::head
