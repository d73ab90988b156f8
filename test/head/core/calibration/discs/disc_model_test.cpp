#include "head/core/calibration/discs/disc_model.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <functional>

#include "common/geometry.hpp"
#include "test/support/ellipses.hpp"
#include "test/support/generated_numbers.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d;
using support::EllipseAt;

constexpr int kHalf_px = 20;  // of the square window
const Vector2d kWindowCentre(100, 80);

DiscModel Truth() {
  const Ellipse e = EllipseAt({100.3, 79.8}, 11, 8, 0.6);
  return {e.centre_px, e.shape_px2.inverse(), 0.8, 120, 40, {0.0004, -0.0003}, {0.3, -0.2}};
}

/// The grey value of the model as its description says: a plateau with slope, faded by a Gaussian across the
/// rim, on a ground with slope.
double GreyOf(const DiscModel& m, const Vector2d& at) {
  const Vector2d d = at - m.centre, kd = m.k * d;
  const double q = std::sqrt(d.dot(kd));
  const double inside_px = q > 0 ? (1 - q) * q / kd.norm() : 100;
  const double share = 0.5 * std::erfc(-inside_px / m.rim_sigma / std::sqrt(2.0));
  return m.background + m.background_slope.dot(d) + m.amplitude * (1 + m.slope.dot(d)) * share;
}

/// The window's pixels one by one, without a core.
WindowPixels PixelsOf(const DiscModel& truth) {
  WindowPixels pixels;
  for (int v = -kHalf_px; v <= kHalf_px; ++v)
    for (int u = -kHalf_px; u <= kHalf_px; ++u) {
      const double grey = GreyOf(truth, kWindowCentre + Vector2d(u, v));
      pixels.shell.push_back({float(u), float(v), static_cast<float>(grey)});
    }
  return pixels;
}

double SquaresOf(const DiscModel& model, const WindowPixels& pixels) {
  return Linearise(model, pixels, kWindowCentre).squares;
}

/// Changes one parameter: centre, slopes (odd) or amplitude, background, shape, rim (even).
using Change = std::function<void(DiscModel&, double)>;
const std::array<Change, 6> kOdd{
    [](DiscModel& m, double h) { m.centre.x() += h; },
    [](DiscModel& m, double h) { m.centre.y() += h; },
    [](DiscModel& m, double h) { m.slope.x() += h; },
    [](DiscModel& m, double h) { m.slope.y() += h; },
    [](DiscModel& m, double h) { m.background_slope.x() += h; },
    [](DiscModel& m, double h) { m.background_slope.y() += h; },
};
const std::array<Change, 6> kEven{
    [](DiscModel& m, double h) { m.amplitude += h; },
    [](DiscModel& m, double h) { m.background += h; },
    [](DiscModel& m, double h) { m.k(0, 0) += h; },
    [](DiscModel& m, double h) { m.k(0, 1) += h, m.k(1, 0) += h; },
    [](DiscModel& m, double h) { m.k(1, 1) += h; },
    [](DiscModel& m, double h) { m.rim_sigma += h; },
};
constexpr std::array<double, 6> kOddStep{0.02, 0.02, 1e-4, 1e-4, 0.01, 0.01};
constexpr std::array<double, 6> kEvenStep{0.5, 0.5, 3e-5, 3e-5, 3e-5, 0.02};

/// The sum of squares when two parameters change; without residuals it is their curvature.
double Curvature(const std::array<Change, 6>& parameters, int i, double hi, int j, double hj) {
  const WindowPixels pixels = PixelsOf(Truth());
  double mixed = 0;
  for (const int sign : {1, -1}) {
    DiscModel model = Truth();
    parameters[i](model, hi);
    parameters[j](model, sign * hj);
    mixed += sign * SquaresOf(model, pixels);
  }
  return mixed / (4 * hi * hj);
}

TEST(DiscModel, ExplainsTheGreyValuesOfItsOwnDescription) {
  const WindowPixels pixels = PixelsOf(Truth());
  const NormalEquations dut = Linearise(Truth(), pixels, kWindowCentre);
  EXPECT_EQ(dut.pixels, (2 * kHalf_px + 1) * (2 * kHalf_px + 1));
  EXPECT_LT(std::sqrt(dut.squares / dut.pixels), 0.02);  // of 120 grey levels: what the table rounds
}

TEST(DiscModel, ItsNormalEquationsAreTheCurvatureOfTheSumOfSquares) {
  const NormalEquations dut = Linearise(Truth(), PixelsOf(Truth()), kWindowCentre);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < i; ++j) {
      const double odd = Curvature(kOdd, i, kOddStep[i], j, kOddStep[j]),
                   even = Curvature(kEven, i, kEvenStep[i], j, kEvenStep[j]);
      EXPECT_NEAR(dut.odd(i, j), odd, 0.08 * std::sqrt(dut.odd(i, i) * dut.odd(j, j))) << i << " " << j;
      EXPECT_NEAR(dut.even(i, j), even, 0.08 * std::sqrt(dut.even(i, i) * dut.even(j, j))) << i << " " << j;
      EXPECT_EQ(dut.odd(i, j), dut.odd(j, i));
      EXPECT_EQ(dut.even(i, j), dut.even(j, i));
    }
}

TEST(DiscModel, EveryParameterThatIsOffIsMendedByItsSteps) {
  const WindowPixels pixels = PixelsOf(Truth());
  for (const auto& [parameters, steps] : {std::pair(kOdd, kOddStep), std::pair(kEven, kEvenStep)})
    for (int i = 0; i < 6; ++i) {
      DiscModel dut = Truth();
      parameters[i](dut, 4 * steps[i]);
      const double before = SquaresOf(dut, pixels);
      for (int k = 0; k < 6; ++k) dut.Step(Linearise(dut, pixels, kWindowCentre));
      EXPECT_LT(SquaresOf(dut, pixels), 0.02 * before) << i;
      EXPECT_LT((dut.centre - Truth().centre).norm(), 0.005) << i;
      EXPECT_NEAR(dut.amplitude, 120, 0.3) << i;
      EXPECT_NEAR(dut.background, 40, 0.1) << i;
      EXPECT_NEAR(dut.rim_sigma, 0.8, 0.02) << i;
      EXPECT_LT((dut.k - Truth().k).norm(), 0.01 * Truth().k.norm()) << i;
    }
}

TEST(DiscModel, ASumOverTheCoreSaysTheSameAsItsPixels) {
  DiscModel off = Truth();
  off.centre += Vector2d(0.2, -0.1);
  off.amplitude += 3;
  off.background -= 2;
  const WindowPixels all = PixelsOf(Truth());
  WindowPixels split;
  for (const auto& p : all.shell) {
    const Vector2d d = kWindowCentre + Vector2d(p.dx, p.dy) - off.centre;
    if (d.dot(off.k * d) > 0.09) {
      split.shell.push_back(p);
      continue;
    }
    GreySums& sums = split.core;
    const Vector2d at(p.dx, p.dy);
    sums.n += 1;
    sums.g += p.grey;
    sums.gg += p.grey * p.grey;
    sums.x += at;
    sums.gx += p.grey * at;
    sums.xx += at * at.transpose();
  }
  ASSERT_GT(split.core.n, 10);
  const NormalEquations one_by_one = Linearise(off, all, kWindowCentre),
                        dut = Linearise(off, split, kWindowCentre);
  EXPECT_EQ(dut.pixels, one_by_one.pixels);
  EXPECT_NEAR(dut.squares, one_by_one.squares, 1e-4 * one_by_one.squares);
  EXPECT_LT((dut.odd - one_by_one.odd).norm(), 1e-6 * one_by_one.odd.norm());
  EXPECT_LT((dut.even - one_by_one.even).norm(), 1e-6 * one_by_one.even.norm());
  EXPECT_LT((dut.odd_rhs - one_by_one.odd_rhs).norm(), 1e-4 * one_by_one.odd_rhs.norm());
  EXPECT_LT((dut.even_rhs - one_by_one.even_rhs).norm(), 1e-4 * one_by_one.even_rhs.norm());
}

TEST(DiscModel, WhatIsFarFromTheLevelOfTheGroundBelongsToSomethingElse) {
  WindowPixels pixels = PixelsOf(Truth());
  const NormalEquations clean = Linearise(Truth(), pixels, kWindowCentre);
  pixels.shell.front().grey += 100;  // a corner of the window
  const NormalEquations dut = Linearise(Truth(), pixels, kWindowCentre);
  EXPECT_EQ(dut.pixels, clean.pixels - 1);
  EXPECT_LT(dut.squares, clean.squares + 1e-6);
  pixels.shell.front().grey -= 90;  // noise
  EXPECT_EQ(Linearise(Truth(), pixels, kWindowCentre).pixels, clean.pixels);
}

TEST(DiscModel, WithoutPixelsThereAreNoEquations) {
  const NormalEquations dut = Linearise(Truth(), {}, kWindowCentre);
  EXPECT_EQ(dut.pixels, 0);
  EXPECT_EQ(dut.odd, NormalEquations::Matrix::Zero());
  EXPECT_EQ(dut.even_rhs, NormalEquations::Vector::Zero());
}

TEST(DiscModel, SlopesThatNothingSupportsAreDrawnBackToZero) {
  DiscModel dut = Truth();
  dut.slope = {0.02, -0.03};
  dut.background_slope = {4, -5};
  WindowPixels one;
  one.shell.push_back({0, 0, 160});
  dut.Step(Linearise(dut, one, kWindowCentre));
  EXPECT_LT(dut.slope.norm(), 1e-3);
  EXPECT_LT(dut.background_slope.norm(), 0.1);
}

TEST(DiscModel, AStepSolvesBothGroupsAndKeepsTheRimWithinBounds) {
  NormalEquations eq;
  eq.odd.diagonal() << 1, 2, 4, 5, 8, 10;
  eq.odd_rhs << 0.5, -0.5, 0.004, 0.01, 0.8, -1;
  eq.even.diagonal() << 2, 2, 1, 1, 1, 1;
  eq.even_rhs << 10, -4, 0.001, 0.002, 0.003, 100;
  const DiscModel start = Truth();
  DiscModel dut = start;
  dut.Step(eq);
  EXPECT_LT((dut.centre - start.centre - Vector2d(0.5, -0.25)).norm(), 1e-5);
  EXPECT_LT((dut.slope - start.slope - Vector2d(0.001, 0.002)).norm(), 1e-7);
  EXPECT_LT((dut.background_slope - start.background_slope - Vector2d(0.1, -0.1)).norm(), 1e-6);
  EXPECT_NEAR(dut.amplitude, 125, 1e-4);
  EXPECT_NEAR(dut.background, 38, 1e-4);
  const Eigen::Matrix2d expected = start.k + (Eigen::Matrix2d() << 0.001, 0.002, 0.002, 0.003).finished();
  EXPECT_LT((dut.k - expected).norm(), 1e-7);
  EXPECT_EQ(dut.rim_sigma, 6);
  eq.even_rhs(5) = -100;
  dut.Step(eq);
  EXPECT_EQ(dut.rim_sigma, 0.28);
}

TEST(DiscModel, TheRimFadesWithinTheReachThatItTells) {
  for (const double sigma : {0.3, 0.8, 2.0}) {
    DiscModel m = Truth();
    m.rim_sigma = sigma;
    const double left = 0.5 * std::erfc(RimFade(m) / sigma / std::sqrt(2.0));
    EXPECT_LT(left, 1e-3) << sigma;
    EXPECT_GT(left, 1e-4) << "farther than needed at " << sigma;
  }
}

}  // namespace
}  // namespace priamos::head
