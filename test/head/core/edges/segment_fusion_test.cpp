#include "head/core/edges/segment_fusion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "common/random.hpp"

namespace priamos::head {
namespace {

/// Least squares line through points with an error in y, as the refit gives it.
class LineFit {
 public:
  void Add(const Eigen::Vector2d& p, double sigma_y) { points_.push_back({p, sigma_y}); }
  EdgeSegment Segment() const {
    double w = 0, wt = 0, ws = 0;
    for (const EdgePoint& p : points_) {
      const double weight = 1 / (p.sigma_normal_px * p.sigma_normal_px);
      w += weight;
      wt += weight * p.at.x();
      ws += weight * p.at.y();
    }
    const double mean = wt / w, offset = ws / w;
    double spread = 0, moment = 0;
    for (const EdgePoint& p : points_) {
      const double weight = 1 / (p.sigma_normal_px * p.sigma_normal_px), t = p.at.x() - mean;
      spread += weight * t * t;
      moment += weight * t * (p.at.y() - offset);
    }
    const double slope = moment / spread, cosine = 1 / std::hypot(1, slope);
    const auto at = [&](double x) { return Eigen::Vector2d(x, offset + slope * (x - mean)); };
    EdgeSegment s;
    s.begin = at(points_.front().at.x());
    s.end = at(points_.back().at.x());
    s.centre = at(mean);
    s.sigma_normal_px = cosine / std::sqrt(w);
    s.sigma_angle_rad = cosine * cosine / std::sqrt(spread);
    return s;
  }

 private:
  std::vector<EdgePoint> points_;
};

/// A horizontal image of pieces with points every 8 px.
class Pieces {
 public:
  Pieces() { image_.width = 768, image_.height = 576; }
  Pieces& Add(Eigen::Vector2d begin, Eigen::Vector2d end, double contrast = 60) {
    EdgeSegment s;
    s.begin = begin;
    s.end = end;
    s.centre = (begin + end) / 2;
    s.sigma_normal_px = 0.03;
    s.sigma_angle_rad = 0.1 / s.length_px();
    s.grey_left = 80;
    s.grey_right = 80 + contrast;
    s.first_point = int(image_.points.size());
    s.n_points = std::max(3, int(s.length_px() / 8));
    for (int i = 0; i < s.n_points; ++i) {
      image_.points.push_back({begin + (end - begin) * ((i + 0.5) / s.n_points), 0.05});
    }
    image_.segments.push_back(s);
    return *this;
  }
  EdgeImage Fused() {
    FuseSegments({}, image_);
    return image_;
  }
  EdgeImage image_;
};

TEST(SegmentFusionTest, JoinsTwoPiecesOfOneEdge) {
  const EdgeImage dut = Pieces().Add({100, 50}, {160, 53}).Add({170, 53.5}, {300, 60}).Fused();
  ASSERT_EQ(dut.segments.size(), 1u);
  EXPECT_NEAR(dut.segments[0].begin.x(), 100, 0.2);
  EXPECT_NEAR(dut.segments[0].end.x(), 300, 0.2);
  EXPECT_NEAR(dut.segments[0].begin.y(), 50, 0.1);
}

TEST(SegmentFusionTest, JoinsAChainOfMany) {
  Pieces pieces;
  for (int i = 0; i < 9; ++i) pieces.Add({50 + 60.0 * i, 200 + 6.0 * i}, {100 + 60.0 * i, 205 + 6.0 * i});
  EXPECT_EQ(pieces.Fused().segments.size(), 1u);
}

TEST(SegmentFusionTest, JoinsOverlappingPieces) {
  EXPECT_EQ(Pieces().Add({100, 50}, {200, 50}).Add({180, 50.1}, {300, 50.1}).Fused().segments.size(), 1u);
}

TEST(SegmentFusionTest, KeepsParallelEdgesApart) {
  EXPECT_EQ(Pieces().Add({100, 50}, {200, 50}).Add({205, 54}, {300, 54}).Fused().segments.size(), 2u);
}

TEST(SegmentFusionTest, KeepsOppositeContrastApart) {
  EXPECT_EQ(Pieces().Add({100, 50}, {200, 50}).Add({300, 50}, {205, 50}).Fused().segments.size(), 2u);
}

TEST(SegmentFusionTest, KeepsBendsApart) {
  EXPECT_EQ(Pieces().Add({100, 50}, {200, 50}).Add({203, 50}, {300, 62}).Fused().segments.size(), 2u);
}

TEST(SegmentFusionTest, DoesNotBridgeWideGaps) {
  EXPECT_EQ(Pieces().Add({100, 50}, {200, 50}).Add({280, 50}, {400, 50}).Fused().segments.size(), 2u);
}

TEST(SegmentFusionTest, DoesNotJoinDifferentContrasts) {
  EXPECT_EQ(Pieces().Add({100, 50}, {200, 50}, 20).Add({205, 50}, {300, 50}, 90).Fused().segments.size(), 2u);
}

/// Pieces of many nearly collinear lines, with equal and chained gaps.
std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> ScatteredPieces() {
  Rng rng(1);
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> pieces;
  for (int i = 0; i < 120; ++i) {
    const double y = 10 + 8 * double(rng.Below(60)), x = rng.Uniform(0, 600);
    const double slope = 0.02 * double(rng.Below(3)), length = rng.Uniform(20, 80);
    pieces.push_back({{x, y + slope * x}, {x + length, y + slope * (x + length)}});
  }
  for (int i = 0; i < 9; ++i) pieces.push_back({{50 + 60.0 * i, 500}, {100 + 60.0 * i, 500}});
  return pieces;
}

TEST(SegmentFusionTest, TheResultDoesNotDependOnTheOrder) {
  auto pieces = ScatteredPieces();
  std::vector<std::vector<double>> results;
  std::mt19937 shuffle(5);
  for (int order = 0; order < 5; ++order) {
    Pieces in_order;
    for (const auto& [begin, end] : pieces) in_order.Add(begin, end);
    std::vector<double> begins;
    for (const EdgeSegment& s : in_order.Fused().segments) begins.push_back(s.begin.x() + 1000 * s.end.y());
    std::sort(begins.begin(), begins.end());
    results.push_back(begins);
    std::shuffle(pieces.begin(), pieces.end(), shuffle);
  }
  EXPECT_LT(results[0].size(), pieces.size() - 15);
  for (const auto& result : results) EXPECT_EQ(result, results[0]);
}

TEST(SegmentFusionTest, IsAFixpoint) {
  Pieces pieces;
  for (const auto& [begin, end] : ScatteredPieces()) pieces.Add(begin, end);
  const EdgeImage once = pieces.Fused();
  EdgeImage twice = once;
  FuseSegments({}, twice);
  ASSERT_EQ(once.segments.size(), twice.segments.size());
  EXPECT_EQ(once.segments[0].begin, twice.segments[0].begin);
  EXPECT_EQ(once.points.size(), twice.points.size());
}

TEST(SegmentFusionTest, KeepsAllPointsOfThePieces) {
  Pieces pieces;
  pieces.Add({100, 50}, {160, 50}).Add({10, 300}, {90, 310}).Add({170, 50}, {300, 50});
  const std::size_t n_points = pieces.image_.points.size();
  const EdgeImage dut = pieces.Fused();
  ASSERT_EQ(dut.segments.size(), 2u);
  ASSERT_EQ(dut.points.size(), n_points);
  for (const EdgeSegment& s : dut.segments) {
    for (int i = 0; i < s.n_points; ++i) {
      const Eigen::Vector2d& at = dut.points[s.first_point + i].at;
      EXPECT_LT(std::abs(s.normal().dot(at - s.begin)), 0.01);
    }
  }
}

TEST(SegmentFusionTest, LeavesASlowCurveInPieces) {
  // Chords of a circle of 500 px radius: each pair looks straight, all together do not.
  Pieces pieces;
  const auto on_circle = [](double angle) {
    return Eigen::Vector2d(384 + 500 * std::sin(angle), 540 - 500 * std::cos(angle));
  };
  constexpr int kChords = 12;
  for (int i = 0; i < kChords; ++i) {
    const double angle = -0.4 + 0.064 * i;
    pieces.Add(on_circle(angle), on_circle(angle + 0.06));
  }
  const EdgeImage dut = pieces.Fused();
  EXPECT_GE(dut.segments.size(), 6u);
  for (const EdgeSegment& s : dut.segments) EXPECT_LT(s.length_px(), 100);
}

TEST(SegmentFusionTest, TheJoinedFitIsTheFitToAllPoints) {
  Rng rng(2);
  for (int run = 0; run < 50; ++run) {
    LineFit a, b, both;
    for (int i = 0; i < 30; ++i) {
      const double t = i < 10 ? 100 + 3 * i : 180 + 4 * i, sigma = i < 10 ? 0.05 : 0.12;
      const Eigen::Vector2d p(t, 40 + 0.3 * t + rng.Normal(sigma));
      (i < 10 ? a : b).Add(p, sigma), both.Add(p, sigma);
    }
    const EdgeSegment joined = JoinFits(a.Segment(), b.Segment()), direct = both.Segment();
    EXPECT_LT(std::abs(direct.normal().dot(joined.centre - direct.centre)), 1e-3);
    EXPECT_LT(std::abs(direct.normal().dot(joined.direction())), 1e-4);
    EXPECT_LT((joined.centre - direct.centre).norm(), 0.5);
    EXPECT_GT(joined.sigma_normal_px, 0.95 * direct.sigma_normal_px);
    EXPECT_GT(joined.sigma_angle_rad, 0.95 * direct.sigma_angle_rad);
  }
}

TEST(SegmentFusionTest, PiecesThatContradictEachOtherAreLessSure) {
  EdgeImage image = Pieces().Add({100, 50}, {200, 50}).Add({205, 50.4}, {300, 50.4}).image_;
  const EdgeSegment agreeing = JoinFits(image.segments[0], image.segments[0]);
  const EdgeSegment contradicting = JoinFits(image.segments[0], image.segments[1]);
  EXPECT_GT(contradicting.sigma_normal_px, 3 * agreeing.sigma_normal_px);
}

TEST(SegmentFusionTest, NothingToFuse) {
  EdgeImage empty;
  FuseSegments({}, empty);
  EXPECT_TRUE(empty.segments.empty());
}

}  // namespace
}  // namespace priamos::head
