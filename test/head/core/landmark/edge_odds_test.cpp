#include "head/core/landmark/edge_odds.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/geometry.hpp"

namespace priamos::head {
namespace {

double Gauss(double x, double sigma) {
  return std::exp(-0.5 * x * x / (sigma * sigma)) / (sigma * std::sqrt(2 * kPi));
}

TEST(EdgeOdds, TheNearestImageEdgeSpeaksForTheLandmarkAndAFarOneIsAsGoodAsNone) {
  const AssociationOptions options{.sigma_px = 0.5, .detection = 0.8};
  const Odds hit = EdgeOdds(0, 0.05, options), far = EdgeOdds(20, 0.05, options);
  EXPECT_NEAR(hit.found, std::log(0.8 * Gauss(0, 0.5) / 0.05 + 0.2), 1e-9);
  EXPECT_NEAR(hit.missed, std::log(0.2), 1e-9);
  EXPECT_NEAR(far.found, far.missed, 1e-9);
}

/// The odds are a ratio of two densities of the grey values beside an edge, so over those of any edge they
/// are 1 on average.
TEST(GreyOdds, AreTheRatioOfTwoDensities) {
  LandmarkEdge edge;
  const AssociationOptions options{.grey_surprise = 0.3};
  for (const double ratio : {0.0, 0.6, -1.2}) {
    edge.grey_ratio = ratio;
    constexpr double kStep = 0.01;
    double mean = 0;
    for (double measured = -6; measured <= 6; measured += kStep)
      mean += std::exp(GreyOdds(edge, measured, options)) * Gauss(measured, options.any_grey_sigma) * kStep;
    EXPECT_NEAR(mean, 1, 1e-6) << ratio;
  }
}

TEST(GreyOdds, AreLeastWhereSomethingElseIsBesideTheEdge) {
  LandmarkEdge edge;
  EXPECT_EQ(GreyOdds(edge, 0.5, {}), 0) << "the model has no grey values";
  edge.grey_ratio = 1;
  const AssociationOptions options{.grey_surprise = 0.1};
  EXPECT_GT(GreyOdds(edge, 1, options), GreyOdds(edge, 0.5, options));
  EXPECT_NEAR(GreyOdds(edge, -2, options), std::log(0.1), 1e-6);
}

TEST(GreyOdds, AreSharperWhereTheEdgeIsSurer) {
  LandmarkEdge edge;
  edge.grey_ratio = 0.5;
  const double usual = GreyOdds(edge, 0.5, {}), usual_beside = GreyOdds(edge, 1.2, {});
  edge.grey_sigma = 0.15;
  EXPECT_GT(GreyOdds(edge, 0.5, {}), usual);
  EXPECT_LT(GreyOdds(edge, 1.2, {}), usual_beside);
}

TEST(CornerOdds, WeighBothOutcomesByTheirChances) {
  const Odds odds = CornerOdds({.corner_detection = 0.4, .corner_chance = 0.06});
  EXPECT_NEAR(odds.found, std::log(0.4 / 0.06), 1e-9);
  EXPECT_NEAR(odds.missed, std::log(0.6 / 0.94), 1e-9);
}

}  // namespace
}  // namespace priamos::head
