#include "planner/core/graph/wall_spans.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace priamos::planner {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

WallSpan Heard(double from_m, double to_m, double seen_s) {
  WallSpan span{from_m, to_m, {}};
  span.wall.seen_s = seen_s;
  return span;
}

TEST(JoinedSpans, NothingIsNothing) {
  EXPECT_THAT(JoinedSpans({}), IsEmpty());
}

TEST(JoinedSpans, PiecesOfOneDriveAreOneWallButForAnOpening) {
  const auto dut = JoinedSpans({Heard(0, 4, 10), Heard(4.2, 6, 25), Heard(7.2, 9, 35)});
  ASSERT_THAT(dut, SizeIs(2));
  EXPECT_EQ(dut[0].from_m, 0);
  EXPECT_EQ(dut[0].to_m, 6);
  EXPECT_EQ(dut[0].wall.seen_s, 25);
  EXPECT_EQ(dut[1].from_m, 7.2);
}

TEST(JoinedSpans, AnOpeningStaysAsWideAsItWasHeardLast) {
  // The second time all was heard 0.4 m farther along.
  const auto dut =
      JoinedSpans({Heard(0, 4, 10), Heard(5.2, 9, 20), Heard(0.4, 4.4, 300), Heard(5.6, 9.4, 310)});
  ASSERT_THAT(dut, SizeIs(2));
  EXPECT_EQ(dut[0].to_m, 4.4);
  EXPECT_EQ(dut[1].from_m, 5.6);
}

TEST(JoinedSpans, WhatWasLeftEarlyDoesNotMakeAWallShorter) {
  const auto dut = JoinedSpans({Heard(0, 4, 10), Heard(1, 2, 300)});
  ASSERT_THAT(dut, SizeIs(1));
  EXPECT_EQ(dut[0].from_m, 0);
  EXPECT_EQ(dut[0].to_m, 4);
  EXPECT_EQ(dut[0].wall.seen_s, 300);
}

TEST(JoinedSpans, APieceMayJoinTwo) {
  EXPECT_THAT(JoinedSpans({Heard(0, 2, 10), Heard(3, 5, 15), Heard(1, 4, 300)}), SizeIs(1));
}

RC_GTEST_PROP(JoinedSpans, NothingOfAWallIsInventedOrCountedTwice, (std::vector<unsigned> numbers)) {
  std::vector<WallSpan> pieces;
  for (const unsigned number : numbers) {
    const double from_m = 0.1 * (number % 100);
    pieces.push_back(Heard(from_m, from_m + 0.5 + 0.1 * (number % 7), number % 1000));
  }
  const auto dut = JoinedSpans(pieces);
  RC_ASSERT(dut.size() <= pieces.size());
  RC_ASSERT(dut.empty() == pieces.empty());
  for (const WallSpan& span : dut) {
    RC_ASSERT(span.from_m < span.to_m);
    const auto is_from = [&](const WallSpan& piece) { return piece.from_m == span.from_m; };
    const auto is_to = [&](const WallSpan& piece) { return piece.to_m == span.to_m; };
    RC_ASSERT(std::any_of(pieces.begin(), pieces.end(), is_from));
    RC_ASSERT(std::any_of(pieces.begin(), pieces.end(), is_to));
  }
}

}  // namespace
}  // namespace priamos::planner
