#include "head/core/calibration/discs/disc_pixels.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>

#include "common/geometry.hpp"
#include "test/support/ellipses.hpp"
#include "test/support/generated_numbers.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d;
using support::Between;
using support::CircleAt;
using support::EllipseAt;
using support::GeneratedRng;

/// One pixel at its place from the centre of the window.
struct Sample {
  Vector2d at;
  double grey;
};

GreyImage NoisyImage(int width, int height, Rng& rng) {
  GreyImage image{width, height, {}};
  for (int i = 0; i < width * height; ++i) image.pixels.push_back(static_cast<std::uint8_t>(rng.Below(256)));
  return image;
}

/// Some rows of random pixels, added to `sums` and one by one to the list that is returned.
std::vector<Sample> AddRows(GreySums& sums, const GreyImage& image, const Vector2d& origin, Rng& rng) {
  std::vector<Sample> samples;
  for (int v = 0; v < image.height; ++v) {
    const int u0 = static_cast<int>(rng.Below(image.width)),
              u1 = u0 + static_cast<int>(rng.Below(image.width - u0));
    const std::uint8_t* row = image.pixels.data() + v * image.width;
    sums.AddRow(row, u0, u1, origin.x(), v - origin.y());
    for (int u = u0; u <= u1; ++u) samples.push_back({Vector2d(u, v) - origin, double(row[u])});
  }
  return samples;
}

bool Near(double a, double b) {
  return std::abs(a - b) <= 1e-9 * (1 + std::abs(a) + std::abs(b));
}

RC_GTEST_PROP(GreySums, RowsSumUpToWhatTheirPixelsDo, ()) {
  Rng rng = GeneratedRng();
  const GreyImage image = NoisyImage(17, 6, rng);
  GreySums dut;
  double n = 0, g = 0, gg = 0;
  Vector2d x = Vector2d::Zero(), gx = Vector2d::Zero();
  Eigen::Matrix2d xx = Eigen::Matrix2d::Zero();
  for (const Sample& s : AddRows(dut, image, {Between(-3, 20), Between(-3, 9)}, rng)) {
    n += 1;
    g += s.grey;
    gg += s.grey * s.grey;
    x += s.at;
    gx += s.grey * s.at;
    xx += s.at * s.at.transpose();
  }
  RC_ASSERT(Near(dut.n, n) && Near(dut.g, g) && Near(dut.gg, gg));
  RC_ASSERT((dut.x - x).norm() < 1e-8 && (dut.gx - gx).norm() < 1e-6 && (dut.xx - xx).norm() < 1e-6);
}

RC_GTEST_PROP(GreySums, ResidualsAgainstALevelWithSlopeAreThoseOfSinglePixels, ()) {
  Rng rng = GeneratedRng();
  const GreyImage image = NoisyImage(12, 5, rng);
  GreySums sums;
  const auto samples = AddRows(sums, image, {5.5, 2.25}, rng);
  const double level = Between(0, 255);
  const Vector2d slope(Between(-2, 2), Between(-2, 2)), shift(Between(-1, 1), Between(-1, 1));
  FlatPixels one_by_one;
  for (const Sample& s : samples) {
    const Vector2d at = s.at + shift;
    one_by_one.Add(at.x(), at.y(), s.grey - level - slope.dot(at));
  }
  const FlatPixels dut = sums.Against(level, slope, shift);
  RC_ASSERT(Near(dut.n, one_by_one.n) && Near(dut.squares, one_by_one.squares));
  RC_ASSERT(std::abs(dut.r - one_by_one.r) < 1e-6);
  RC_ASSERT(std::abs(dut.rx - one_by_one.rx) < 1e-6 && std::abs(dut.ry - one_by_one.ry) < 1e-6);
  RC_ASSERT(Near(dut.xx, one_by_one.xx) && Near(dut.xy, one_by_one.xy) && Near(dut.yy, one_by_one.yy));
}

/// The normal equations from the derivatives of every pixel: brightness and background with their slopes.
RC_GTEST_PROP(FlatPixels, MakeTheNormalEquationsOfTheirPixels, ()) {
  const double amplitude = *rc::gen::arbitrary<bool>() ? Between(10, 200) : 0;
  Rng rng = GeneratedRng();
  FlatPixels dut;
  NormalEquations expected, got;
  for (int i = 0; i < 20; ++i) {
    const double dx = rng.Uniform(-9, 9), dy = rng.Uniform(-9, 9), residual = rng.Uniform(-20, 20);
    dut.Add(dx, dy, residual);
    NormalEquations::Vector odd, even;
    odd << 0, 0, amplitude * dx, amplitude * dy, dx, dy;
    even << (amplitude > 0 ? 1 : 0), 1, 0, 0, 0, 0;
    expected.odd += odd * odd.transpose();
    expected.odd_rhs += residual * odd;
    expected.even += even * even.transpose();
    expected.even_rhs += residual * even;
    expected.squares += residual * residual;
  }
  dut.AddTo(got, amplitude);
  RC_ASSERT((got.odd - expected.odd).norm() <= 1e-9 * (1 + expected.odd.norm()));
  RC_ASSERT((got.odd_rhs - expected.odd_rhs).norm() <= 1e-9 * (1 + expected.odd_rhs.norm()));
  RC_ASSERT((got.even - expected.even).norm() < 1e-9 && (got.even_rhs - expected.even_rhs).norm() < 1e-9);
  RC_ASSERT(Near(got.squares, expected.squares));
  RC_ASSERT(got.pixels == 20);
}

/// Every pixel of the window is either in the shell or in the core, never in both.
RC_GTEST_PROP(WindowPixels, ShellAndCoreTogetherAreTheWindow, ()) {
  Rng rng = GeneratedRng();
  const GreyImage image = NoisyImage(64, 48, rng);
  const Ellipse disc =
      EllipseAt({Between(30, 33), Between(22, 25)}, Between(6, 14), Between(5, 6), Between(0, kPi));
  const Ellipse window = Grown(disc, 3.5);
  WindowPixels dut;
  dut.Collect(image, disc, window, {}, Between(1, 4));
  double n = 0, g = 0, gg = 0;
  ForEachPixel(image, *BoundingBox(image, window), window, {}, [&](double, double, double, int grey) {
    n += 1;
    g += grey;
    gg += grey * grey;
  });
  for (const auto& p : dut.shell) {
    n -= 1;
    g -= p.grey;
    gg -= p.grey * p.grey;
  }
  RC_ASSERT(Near(n, dut.core.n) && Near(g, dut.core.g) && Near(gg, dut.core.gg));
}

TEST(WindowPixels, TheCoreIsWhatLiesFartherInsideThanTheMargin) {
  Rng rng(3);
  const GreyImage image = NoisyImage(64, 48, rng);
  const Ellipse disc = CircleAt(31.3, 24.6, 12);
  WindowPixels dut;
  dut.Collect(image, disc, Grown(disc, 3.5), {}, 4);
  int inside = 0;
  for (int v = 0; v < 48; ++v)
    for (int u = 0; u < 64; ++u) inside += (Vector2d(u, v) - disc.centre_px).norm() < 8;
  EXPECT_EQ(dut.core.n, inside);
  for (const auto& p : dut.shell) EXPECT_GT(std::hypot(p.dx, p.dy), 8 - 1e-5);
  EXPECT_EQ(dut.margin_px, 4);
}

TEST(WindowPixels, ADiscSmallerThanTheMarginHasNoCore) {
  Rng rng(3);
  WindowPixels dut;
  dut.Collect(NoisyImage(64, 48, rng), CircleAt(30, 24, 3), CircleAt(30, 24, 6.5), {}, 3.5);
  EXPECT_EQ(dut.core.n, 0);
  EXPECT_NEAR(static_cast<double>(dut.shell.size()), kPi * 6.5 * 6.5, 15);
}

TEST(WindowPixels, BesideOtherSpotsEveryPixelIsLookedAtAndTheirsAreLeftOut) {
  Rng rng(3);
  const std::vector<Ellipse> others{CircleAt(44, 24, 5)};
  WindowPixels dut;
  dut.Collect(NoisyImage(64, 48, rng), CircleAt(30, 24, 9), CircleAt(30, 24, 12.5), others, 2);
  EXPECT_EQ(dut.core.n, 0);
  std::set<std::pair<float, float>> places;
  for (const auto& p : dut.shell) {
    EXPECT_FALSE(Within(others[0], 30 + p.dx, 24 + p.dy));
    EXPECT_TRUE(places.insert({p.dx, p.dy}).second);
  }
  EXPECT_TRUE(places.contains({0, 0}));
  EXPECT_FALSE(places.contains({12, 0}));
}

TEST(WindowPixels, AWindowThatLeavesTheImageHoldsNothing) {
  Rng rng(3);
  const GreyImage image = NoisyImage(64, 48, rng);
  WindowPixels dut;
  dut.Collect(image, CircleAt(30, 24, 9), CircleAt(30, 24, 12), {}, 2);
  EXPECT_FALSE(dut.shell.empty());
  dut.Collect(image, CircleAt(10, 24, 9), CircleAt(10, 24, 12), {}, 2);
  EXPECT_TRUE(dut.shell.empty());
  EXPECT_EQ(dut.core.n, 0);
}

}  // namespace
}  // namespace priamos::head
