#include "head/core/landmark/model_errors.hpp"

#include <gmock/gmock.h>

namespace priamos::head {
namespace {

constexpr ModelVariance kBefore{.edge_m2 = 25e-6, .movable_m2 = 1e-4, .breadth_m2 = 1e-4};

/// A left edge, a right one, and one of a leaf.
LandmarkModel ThreeEdges() {
  LandmarkModel model;
  for (const int side : {1, 2, 3}) {
    LandmarkEdge edge;
    edge.side = side;
    edge.to = {0, 0, 2};
    model.edges.push_back(edge);
  }
  return model;
}

ModelErrors Known(const LandmarkModel& model, double sigma_m) {
  ModelErrors errors;
  errors.mean = Eigen::VectorXd::LinSpaced(ModelErrors::SizeFor(model), 0.001, 0.010);
  errors.covariance = sigma_m * sigma_m *
                      (0.5 * Eigen::MatrixXd::Identity(errors.mean.size(), errors.mean.size()) +
                       0.5 * Eigen::MatrixXd::Ones(errors.mean.size(), errors.mean.size()));
  return errors;
}

TEST(ModelErrors, EdgesOfABroaderLandmarkLieFartherToTheirSides) {
  const LandmarkModel model = ThreeEdges();
  Eigen::VectorXd errors = Eigen::VectorXd::Zero(10);
  errors(0) = 0.002;
  errors(9) = 0.010;
  const EdgeShifts shifts = ShiftsOf(model, errors);
  ASSERT_EQ(shifts.size(), 3U);
  EXPECT_TRUE(shifts[0].isApprox(Eigen::Vector3d(0.002, 0.005, 0)));
  EXPECT_TRUE(shifts[1].isApprox(Eigen::Vector3d(0, -0.005, 0)));
  EXPECT_TRUE(shifts[2].isZero());
  EXPECT_TRUE(Shifted(model, shifts).edges[0].to.isApprox(Eigen::Vector3d(0.002, 0.005, 2)));
}

TEST(ModelErrors, AHigherLandmarkLiftsAllThatIsLevelByItsShare) {
  LandmarkModel model = ThreeEdges();  // 2 m high
  model.edges.push_back({{0, -1, 2}, {0, 1, 2}});
  model.edges.push_back({{0, -1, 1}, {0, 1, 1}});
  ModelVariance before = kBefore;
  before.height_m2 = 16e-6;
  const Eigen::MatrixXd dut = before.CovarianceFor(model);
  EXPECT_NEAR(dut(11, 11), kBefore.edge_m2 + 16e-6, 1e-12);
  EXPECT_NEAR(dut(11, 14), 8e-6, 1e-12);
  EXPECT_NEAR(dut(14, 14), kBefore.edge_m2 + 4e-6, 1e-12);
  EXPECT_EQ(dut(2, 11), 0) << "uprights only become longer";
  EXPECT_EQ(dut(9, 12), 0);
}

TEST(ModelErrors, EdgesOfOneFaceStandOutTogether) {
  LandmarkModel model = ThreeEdges();  // the third one moves
  model.edges.push_back({{0.1, -1, 0}, {0.1, -1, 2}});
  ModelVariance before = kBefore;
  before.depth_m2 = 9e-6;
  const Eigen::MatrixXd dut = before.CovarianceFor(model);
  EXPECT_NEAR(dut(0, 0), kBefore.edge_m2 + 9e-6, 1e-12);
  EXPECT_NEAR(dut(0, 3), 9e-6, 1e-12);
  EXPECT_EQ(dut(0, 6), 0) << "a leaf's edge does not belong to the face";
  EXPECT_EQ(dut(0, 9), 0) << "another face";
  EXPECT_EQ(dut(1, 4), 0) << "along x only";
}

TEST(ModelErrors, ALeafMayHaveBeenMovedAndTheRestStays) {
  const LandmarkModel model = ThreeEdges();
  const ModelErrors known = Known(model, 0.001), dut = CarriedOver(known, model, kBefore);
  EXPECT_EQ(dut.mean.head<6>(), known.mean.head<6>());
  EXPECT_TRUE(dut.mean.segment<3>(6).isZero());
  EXPECT_NEAR(dut.covariance(7, 7), kBefore.movable_m2, 1e-12);
  EXPECT_EQ(dut.covariance(7, 0), 0);
  EXPECT_EQ(dut.covariance(0, 4), known.covariance(0, 4)) << "errors that they share stay shared";
  EXPECT_GT(dut.covariance(0, 0), known.covariance(0, 0)) << "each look errs alike";
  EXPECT_LT(dut.covariance(0, 0), 0.1 * kBefore.edge_m2);
}

TEST(ModelErrors, WhatIsExactByTheOptionsStaysExact) {
  const LandmarkModel model = ThreeEdges();
  ModelErrors known = Known(model, 0);
  const ModelErrors dut = CarriedOver(known, model, {});
  EXPECT_TRUE(dut.covariance.isZero());
}

TEST(ModelErrors, OfContradictedErrorsOnlyTheBreadthIsKept) {
  const LandmarkModel model = ThreeEdges();
  const ModelErrors known = Known(model, 0.001), dut = OnlyBreadth(known, model, kBefore);
  EXPECT_NEAR(dut.breadth().broader_m, 0.010, 1e-12);
  EXPECT_NEAR(dut.breadth().sigma_m, 0.001, 1e-12);
  EXPECT_TRUE(dut.mean.head<9>().isZero());
  EXPECT_NEAR(dut.covariance(0, 0), kBefore.edge_m2, 1e-15);
  EXPECT_TRUE(OnlyBreadth({}, model, kBefore).empty());
}

}  // namespace
}  // namespace priamos::head
