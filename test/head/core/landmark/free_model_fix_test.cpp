#include "head/core/landmark/free_model_fix.hpp"

#include <gtest/gtest.h>

#include "head/core/edges/edge_segments.hpp"
#include "test/support/quad_scene.hpp"

namespace priamos::head {
namespace {

/// A cupboard of 0.6 x 0.8 x 1.2 m, its front at x = 0, each face with its grey value.
struct Cupboard {
  Polyhedron body;
  std::vector<test::Quad> quads;

  Cupboard() {
    const double x = 0.6, y = 0.8, z = 1.2;
    body.points = {{0, 0, 0}, {0, y, 0}, {0, y, z}, {0, 0, z}, {x, 0, 0}, {x, y, 0}, {x, y, z}, {x, 0, z}};
    body.faces = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 4, 7, 3}, {1, 2, 6, 5}, {3, 7, 6, 2}, {0, 1, 5, 4}};
    const auto quad = [&](int corner, int u, int v, double grey) {
      const auto& p = body.points;
      quads.push_back({p[corner], p[u] - p[corner], p[v] - p[corner], grey});
    };
    quad(0, 1, 3, 180);
    quad(4, 5, 7, 180);
    quad(0, 4, 3, 120);
    quad(1, 5, 2, 140);
    quad(3, 7, 2, 210);
  }
};

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
  const Cupboard cupboard_;
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
