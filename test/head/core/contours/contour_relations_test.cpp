#include "head/core/contours/contour_relations.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <optional>

#include "common/geometry.hpp"
#include "test/support/generated_numbers.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d;
using support::Between;

constexpr double kSigma_px = 1e-3;  ///< so exact that tolerances are those of the options

EdgeSegment Segment(const Vector2d& begin, const Vector2d& end, double sigma_px = kSigma_px) {
  EdgeSegment s;
  s.begin = begin;
  s.end = end;
  s.centre = (begin + end) / 2;
  s.sigma_normal_px = sigma_px;
  s.sigma_angle_rad = sigma_px / s.length_px();
  s.grey_left = 80;
  s.grey_right = 140;
  return s;
}

EdgeImage Image(std::vector<EdgeSegment> segments) {
  EdgeImage image;
  image.width = 768;
  image.height = 576;
  image.segments = std::move(segments);
  return image;
}

std::optional<Relation> Related(const EdgeSegment& a, const EdgeSegment& b,
                                const ContourOptions& options = {}) {
  const auto relations = FindRelations(Image({a, b}), options);
  return relations.empty() ? std::nullopt : std::optional(relations.front());
}

/// From the origin of both tests' pictures, `length` px at this angle.
EdgeSegment Ray(const Vector2d& from, double angle_rad, double length = 100) {
  return Segment(from, from + length * Vector2d(std::cos(angle_rad), std::sin(angle_rad)));
}

const EdgeSegment kLevel = Segment({200, 200}, {300, 200});

TEST(FindRelationsTest, NeighboursAreParallelUpToATolerance) {
  const ContourOptions options{.parallel_rad = 0.03};
  EXPECT_TRUE(Related(kLevel, Ray({200, 215}, 0.029), options)->parallel);
  EXPECT_FALSE(Related(kLevel, Ray({200, 215}, 0.031), options));
  EXPECT_TRUE(Related(kLevel, Ray({300, 215}, kPi - 0.029), options)->parallel) << "either way round";
}

TEST(FindRelationsTest, ParallelEdgesFaceTheSameWayOrNot) {
  const auto same = Related(kLevel, Segment({200, 215}, {300, 215})),
             opposite = Related(kLevel, Segment({300, 215}, {200, 215}));
  ASSERT_TRUE(same && opposite);
  EXPECT_TRUE(same->same_sign);
  EXPECT_FALSE(opposite->same_sign);
  EXPECT_NEAR(same->angle_rad, 0, 1e-9);
  EXPECT_NEAR(opposite->angle_rad, 0, 1e-9);
}

TEST(FindRelationsTest, ParallelEdgesOverlapAndCollinearOnesFollowEachOther) {
  const auto beside = Related(kLevel, Segment({290, 210}, {390, 210}));
  ASSERT_TRUE(beside);
  EXPECT_TRUE(beside->parallel && !beside->collinear);
  EXPECT_NEAR(beside->distance_px, 10, 1e-9);
  EXPECT_FALSE(Related(kLevel, Segment({310, 210}, {410, 210}))) << "neither beside nor behind it";
  const auto behind = Related(kLevel, Segment({310, 200.5}, {410, 200.5}));
  ASSERT_TRUE(behind);
  EXPECT_TRUE(behind->collinear && !behind->parallel);
}

TEST(FindRelationsTest, CollinearEdgesLieBesideEachOtherByLittle) {
  const ContourOptions options{.collinear_px = 0.8};
  EXPECT_TRUE(Related(kLevel, Segment({310, 200.79}, {410, 200.79}), options));
  EXPECT_FALSE(Related(kLevel, Segment({310, 200.83}, {410, 200.83}), options));
  const EdgeSegment vague = Segment({310, 201.5}, {410, 201.5}, 0.3);
  EXPECT_TRUE(Related(kLevel, vague, options)) << "3 sigma of it are 0.9 px";
}

TEST(FindRelationsTest, TheShorterEdgeTellsTheDistance) {
  const EdgeSegment turned = Ray({240, 220}, 0.02, 20);
  const auto dut = Related(kLevel, turned);
  ASSERT_TRUE(dut);
  EXPECT_NEAR(dut->distance_px, (turned.begin.y() + turned.end.y()) / 2 - 200, 1e-9);
  EXPECT_NEAR(Related(turned, kLevel)->distance_px, dut->distance_px, 1e-9);
}

TEST(FindRelationsTest, PerpendicularUpToATolerance) {
  const ContourOptions options{.perpendicular_rad = 0.05};
  for (const double sign : {-1.0, 1.0}) {
    const auto dut = Related(kLevel, Ray({250, 220}, sign * (kPi / 2 - 0.049)), options);
    ASSERT_TRUE(dut);
    EXPECT_TRUE(dut->perpendicular);
    EXPECT_NEAR(dut->angle_rad, kPi / 2 - 0.049, 1e-9);
  }
  EXPECT_FALSE(Related(kLevel, Ray({250, 220}, kPi / 2 - 0.051), options))
      << "and it does not reach the other";
}

TEST(FindRelationsTest, FartherOnesAreNoNeighbours) {
  const ContourOptions options{.neighbour_px = 30};
  EXPECT_TRUE(Related(kLevel, Segment({200, 229}, {300, 229}), options));
  EXPECT_FALSE(Related(kLevel, Segment({200, 231}, {300, 231}), options));
  EXPECT_TRUE(Related(kLevel, Segment({329, 200}, {420, 200}), options));
  EXPECT_FALSE(Related(kLevel, Segment({331, 200}, {420, 200}), options));
}

TEST(FindRelationsTest, LinesThatReachTheirCrossingIntersect) {
  const ContourOptions options{.max_extension_px = 15};
  const auto reach = [&](double gap) { return Related(kLevel, Ray({250, 200 + gap}, 1.0), options); };
  ASSERT_TRUE(reach(11));
  EXPECT_TRUE(reach(11)->intersecting) << "11 px down are 13 along the line";
  EXPECT_FALSE(reach(13)) << "15.4 px along the line";
  EXPECT_TRUE(reach(-20)->intersecting) << "they cross";
}

TEST(FindRelationsTest, AShortLineIsExtendedByAShareOfItself) {
  const ContourOptions options{.max_extension_px = 15, .max_extension_share = 0.5};
  const auto with_length = [&](double length) {
    return Related(kLevel, Ray({250, 210}, 1.2, length), options);
  };
  EXPECT_TRUE(with_length(22)) << "10.7 px are less than half";
  EXPECT_FALSE(with_length(21));
}

TEST(FindRelationsTest, TheFirstIndexIsTheSmallerOne) {
  std::vector<EdgeSegment> bundle;
  for (int i = 0; i < 6; ++i) bundle.push_back(Segment({200, 200.0 + 5 * i}, {300, 200.0 + 5 * i}));
  const auto relations = FindRelations(Image(bundle), {});
  EXPECT_EQ(relations.size(), 15u) << "every pair once";
  for (const Relation& r : relations) EXPECT_LT(r.a, r.b);
}

TEST(FindCornersTest, ACornerIsWhereBothLinesMeet) {
  const auto corners =
      FindCorners(Image({Segment({200, 200}, {290, 200}), Segment({300, 205}, {300, 300})}), {});
  ASSERT_EQ(corners.size(), 1u);
  EXPECT_LT((corners[0].at - Vector2d(300, 200)).norm(), 1e-9);
  EXPECT_NEAR(corners[0].extension_px[0], 10, 1e-9);
  EXPECT_NEAR(corners[0].extension_px[1], 5, 1e-9);
  EXPECT_EQ(corners[0].ends, (std::array{1, 0}));
}

TEST(FindCornersTest, ASideThatRunsOnIsShortened) {
  const auto corners =
      FindCorners(Image({Segment({200, 200}, {304, 200}), Segment({300, 300}, {300, 197})}), {});
  ASSERT_EQ(corners.size(), 1u);
  EXPECT_NEAR(corners[0].extension_px[0], -4, 1e-9);
  EXPECT_NEAR(corners[0].extension_px[1], -3, 1e-9);
  EXPECT_EQ(corners[0].ends, (std::array{1, 1}));
}

TEST(FindCornersTest, ExtensionsHaveABound) {
  const auto with_gap = [](double gap) {
    return FindCorners(Image({Segment({200, 200}, {300 - gap, 200}), Segment({300, 200}, {300, 300})}), {})
        .size();
  };
  EXPECT_EQ(with_gap(14.9), 1u);
  EXPECT_EQ(with_gap(15.1), 0u);
  const auto short_side = [](double length) {
    return FindCorners(Image({Segment({290 - length, 200}, {290, 200}), Segment({300, 200}, {300, 300})}), {})
        .size();
  };
  EXPECT_EQ(short_side(20.1), 1u);
  EXPECT_EQ(short_side(19.9), 0u) << "more than half of it would be made up";
}

TEST(FindCornersTest, FlatCrossingsAreNoCorners) {
  const auto at_angle = [](double angle) {
    return FindCorners(Image({Segment({200, 200}, {300, 200}), Ray({302, 200}, angle)}), {}).size();
  };
  EXPECT_EQ(at_angle(0.21), 1u);
  EXPECT_EQ(at_angle(0.19), 0u);
  EXPECT_EQ(at_angle(kPi - 0.21), 1u) << "back along the first";
  EXPECT_EQ(at_angle(kPi - 0.19), 0u);
}

/// A level line and five upright ones behind its end, each 2 px farther away.
std::vector<EdgeSegment> Fence() {
  std::vector<EdgeSegment> segments{Segment({200, 200}, {300, 200})};
  for (int i = 0; i < 5; ++i) segments.push_back(Segment({302.0 + 2 * i, 201}, {302.0 + 2 * i, 260}));
  return segments;
}

TEST(FindCornersTest, ACornerIsKeptIfEitherSideKnowsNoBetterOne) {
  EXPECT_EQ(FindCorners(Image(Fence()), {.max_corners_per_end = 5}).size(), 5u);
  EXPECT_EQ(FindCorners(Image(Fence()), {.max_corners_per_end = 1}).size(), 5u);
}

TEST(FindCornersTest, EveryEndKeepsItsNearestCorners) {
  auto segments = Fence();
  segments.push_back(Segment({200, 200.5}, {301, 200.5}));  // nearer to every upright line
  const auto corners = FindCorners(Image(segments), {.max_corners_per_end = 1});
  EXPECT_EQ(corners.size(), 6u) << "one of the first line, and one of every upright";
  for (const Corner& c : corners) EXPECT_TRUE(c.segments[0] == 0 ? c.segments[1] == 1 : c.segments[1] == 6);
  EXPECT_EQ(FindCorners(Image(segments), {.max_corners_per_end = 5}).size(), 10u);
}

RC_GTEST_PROP(FindCornersTest, ErrorsOfBothLinesMakeThatOfTheCorner, ()) {
  const double angle = Between(0.4, kPi - 0.4), sigma_a = Between(0.01, 0.1), sigma_b = Between(0.01, 0.1);
  const Vector2d at(300, 300), u(1, 0), v(std::cos(angle), std::sin(angle));
  auto a = Segment(at - 80 * u, at, sigma_a), b = Segment(at, at + 60 * v, sigma_b);
  const auto corners = FindCorners(Image({a, b}), {});
  RC_ASSERT(corners.size() == 1u);
  RC_ASSERT((corners[0].at - at).norm() < 1e-9);
  // Moving a line by d across it moves the corner along the other one by d / sin of the angle.
  const double at_a = std::hypot(sigma_a, 40 * a.sigma_angle_rad),
               at_b = std::hypot(sigma_b, 30 * b.sigma_angle_rad);
  const Eigen::Matrix2d expected =
      (at_a * at_a * v * v.transpose() + at_b * at_b * u * u.transpose()) / std::pow(std::sin(angle), 2);
  RC_ASSERT((corners[0].covariance - expected).norm() < 1e-9);
}

TEST(FindCornersTest, CornersAreSortedAndEachIsThereOnce) {
  std::vector<EdgeSegment> segments;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 2; ++k)
      segments.push_back(Ray({250.0 + 3 * k, 250}, i * kPi / 2 + 0.3 + 0.25 * k, 60));
  const auto corners = FindCorners(Image(segments), {.max_corners_per_end = 8});
  ASSERT_GT(corners.size(), 8u);
  const auto key = [](const Corner& c) {
    return std::array{c.segments[0], c.ends[0], c.segments[1], c.ends[1]};
  };
  for (std::size_t i = 0; i < corners.size(); ++i) {
    EXPECT_LT(corners[i].segments[0], corners[i].segments[1]);
    if (i > 0) {
      EXPECT_LT(key(corners[i - 1]), key(corners[i]));
    }
  }
}

}  // namespace
}  // namespace priamos::head
