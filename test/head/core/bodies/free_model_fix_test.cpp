#include "head/core/bodies/free_model_fix.hpp"

#include <gtest/gtest.h>

#include "head/core/edges/edge_segments.hpp"
#include "test/head/core/bodies/grey_cupboard.hpp"

namespace priamos::head {
namespace {

class FreeModelFixTest : public testing::Test {
 protected:
  FreeModelFix Find(const Eigen::Isometry3d& truth, const Eigen::Isometry3d& believed, double light = 1) {
    std::vector<test::Quad> lit = cupboard_.quads;
    for (test::Quad& quad : lit) quad.grey *= light;
    EdgeOperator op;
    op.Extract(test::RenderQuads(lit, truth, left_, 2, rng_, 60 * light), edges_[0]);
    op.Extract(test::RenderQuads(lit, truth, right_, 2, rng_, 60 * light), edges_[1]);
    views_ = {MakeView(left_, edges_[0]), MakeView(right_, edges_[1])};
    return LocateFreeModel(cupboard_.body, believed, views_, {});
  }

  static Eigen::Isometry3d At(double x, double y, double z, double yaw) {
    Eigen::Isometry3d t(Eigen::Translation3d(x, y, z) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
    return t;
  }

  Rng rng_{3};
  const CameraModel left_ = test::HeadCamera(0, 1, 700), right_ = test::HeadCamera(0, -1, 700);
  test::GreyCupboard cupboard_;
  EdgeImage edges_[2];
  std::vector<CameraView> views_;
};

TEST_F(FreeModelFixTest, FindsTheCupboardInSpace) {
  const Eigen::Isometry3d truth = At(2.6, -0.4, 0.2, 0.3);
  Eigen::Isometry3d believed = truth;
  believed.pretranslate(Eigen::Vector3d(0.02, -0.015, 0.01));
  believed.rotate(Eigen::AngleAxisd(0.02, Eigen::Vector3d(1, 2, -1).normalized()));
  const FreeModelFix dut = Find(truth, believed);
  ASSERT_EQ(dut.verdict, Verdict::kFound) << Describe(dut.verdict);
  EXPECT_LT((dut.base_from_model.translation() - truth.translation()).norm(), 0.003);
  EXPECT_LT(Eigen::AngleAxisd((truth.linear().transpose() * dut.base_from_model.linear()).eval()).angle(),
            0.002);
  EXPECT_GT(dut.covariance.diagonal().minCoeff(), 0);
}

TEST_F(FreeModelFixTest, IsFoundFromFarBesideTheTruth) {
  const Eigen::Isometry3d truth = At(2.6, -0.4, 0.2, 0.3);
  for (const double sign : {1.0, -1.0}) {
    Eigen::Isometry3d believed = truth;
    believed.pretranslate(Eigen::Vector3d(0.12 * sign, 0.08, -0.05 * sign));
    believed.rotate(Eigen::AngleAxisd(0.05 * sign, Eigen::Vector3d(1, 2, -1).normalized()));
    const FreeModelFix dut = Find(truth, believed);
    ASSERT_EQ(dut.verdict, Verdict::kFound) << Describe(dut.verdict);
    EXPECT_LT((dut.base_from_model.translation() - truth.translation()).norm(), 0.003);
    EXPECT_LT(dut.rival_log_odds, dut.log_odds - 4);
  }
}

TEST_F(FreeModelFixTest, TheCovarianceFollowsFromHowWellTheEdgesFit) {
  const Eigen::Isometry3d truth = At(2.6, -0.4, 0.2, 0.3);
  Find(truth, truth);
  FreeModelOptions told_badly, told_well;
  told_badly.solver.model_sigma_m = 0.003;
  told_well.solver.model_sigma_m = 0.0002;
  const auto badly = LocateFreeModel(cupboard_.body, truth, views_, told_badly);
  const auto well = LocateFreeModel(cupboard_.body, truth, views_, told_well);
  ASSERT_EQ(badly.verdict, Verdict::kFound);
  ASSERT_EQ(well.verdict, Verdict::kFound);
  const double ratio = std::sqrt(badly.covariance.trace() / well.covariance.trace());
  EXPECT_LT(ratio, 3) << "the models' standard deviations differ by 15, the model is exact";
  EXPECT_GT(ratio, 1.0 / 3);
}

TEST_F(FreeModelFixTest, AnotherCupboardIsNotFound) {
  const Eigen::Isometry3d truth = At(2.6, -0.4, 0.2, 0.3);
  for (test::Quad& quad : cupboard_.quads) {
    for (Eigen::Vector3d* v : {&quad.corner, &quad.u, &quad.v})
      *v = v->cwiseProduct(Eigen::Vector3d(1, 1.2, 0.85));
  }
  EXPECT_NE(Find(truth, truth).verdict, Verdict::kFound);
}

TEST_F(FreeModelFixTest, WhatIsHiddenIsNotLookedFor) {
  const FreeModelFix dut = Find(At(2.6, -0.4, 0.2, 0.3), At(2.6, -0.4, 0.2, 0.3));
  ASSERT_EQ(dut.verdict, Verdict::kFound);
  EXPECT_LT(dut.seen.edges.size(), 12u) << "edges of a box";
}

TEST_F(FreeModelFixTest, DarknessIsNoImage) {
  EXPECT_EQ(Find(At(2.6, -0.4, 0.2, 0.3), At(2.6, -0.4, 0.2, 0.3), 0).verdict, Verdict::kNoImage);
  EXPECT_EQ(LocateFreeModel(cupboard_.body, At(2.6, 0, 0, 0), {}, {}).verdict, Verdict::kNoImage);
}

TEST_F(FreeModelFixTest, ABodyBehindTheCamerasIsNotVisible) {
  EXPECT_EQ(Find(At(2.6, -0.4, 0.2, 0.3), At(-3, 0, 0, 0)).verdict, Verdict::kNotVisible);
}

TEST_F(FreeModelFixTest, ABodyThatIsNotThereIsNotFound) {
  const FreeModelFix dut = Find(At(2.6, -0.4, 0.2, 0.3), At(3.4, 0.5, 0.2, -0.2));
  EXPECT_NE(dut.verdict, Verdict::kFound);
}

TEST_F(FreeModelFixTest, SwappedImagesGiveNoFix) {
  const Eigen::Isometry3d truth = At(2.6, -0.4, 0.2, 0.3);
  Find(truth, truth);
  views_ = {MakeView(left_, edges_[1]), MakeView(right_, edges_[0])};
  EXPECT_NE(LocateFreeModel(cupboard_.body, truth, views_, {}).verdict, Verdict::kFound);
}

}  // namespace
}  // namespace priamos::head
