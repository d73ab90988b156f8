#include "head/core/edges/segment_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/geometry.hpp"

namespace priamos::head {
namespace {

EdgeSegment Segment(double x1, double y1, double x2, double y2) {
  EdgeSegment segment;
  segment.begin = {x1, y1};
  segment.end = {x2, y2};
  return segment;
}

class SegmentMapTest : public testing::Test {
 protected:
  SegmentMapTest() { map_.Clear(200, 100); }

  void Draw(const EdgeSegment& segment) {
    segments_.push_back(segment);
    map_.Draw(segment, static_cast<int>(segments_.size()) - 1);
  }

  SegmentMap map_;
  std::vector<EdgeSegment> segments_;
};

TEST_F(SegmentMapTest, APieceOfASegmentIsCoveredInEveryDirection) {
  for (int degrees = 0; degrees < 360; degrees += 7) {
    const double c = std::cos(degrees * kPi / 180), s = std::sin(degrees * kPi / 180);
    map_.Clear(200, 100);
    segments_.clear();
    Draw(Segment(100 - 45 * c, 50 - 45 * s, 100 + 45 * c, 50 + 45 * s));
    EXPECT_TRUE(map_.Covers({100 - 10 * c, 50 - 10 * s, 100 + 8 * c, 50 + 8 * s}, segments_)) << degrees;
    EXPECT_FALSE(map_.Covers({100 + 10 * c, 50 + 10 * s, 100 - 8 * c, 50 - 8 * s}, segments_))
        << "the other contrast, " << degrees;
    EXPECT_FALSE(map_.Covers({100 - 4 * s, 50 + 4 * c, 100 - 4 * s + 20 * c, 50 + 4 * c + 20 * s}, segments_))
        << "4 px beside it, " << degrees;
  }
}

TEST_F(SegmentMapTest, WhatReachesFarBeyondTheSegmentIsNotCovered) {
  Draw(Segment(20, 50, 80, 50));
  EXPECT_TRUE(map_.Covers({22, 50, 80, 50}, segments_));
  EXPECT_FALSE(map_.Covers({60, 50, 120, 50}, segments_));
}

TEST_F(SegmentMapTest, PiecesOfTwoSegmentsAreNotOne) {
  Draw(Segment(20, 50, 60, 50));
  Draw(Segment(62, 50, 100, 50));
  EXPECT_FALSE(map_.Covers({40, 50, 80, 50}, segments_));
}

TEST_F(SegmentMapTest, LinesOutsideTheImageAreHarmless) {
  Draw(Segment(-30, -20, 250, 130));
  EXPECT_FALSE(map_.Covers({-50, -50, -10, -10}, segments_));
  EXPECT_FALSE(map_.Covers({500, 500, 900, 700}, segments_));
}

TEST_F(SegmentMapTest, ClearForgets) {
  Draw(Segment(20, 50, 80, 50));
  map_.Clear(200, 100);
  EXPECT_FALSE(map_.Covers({30, 50, 70, 50}, segments_));
}

}  // namespace
}  // namespace priamos::head
