#include "bus/radio/channels/frames_ahead.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace priamos::bus::radio {
namespace {

TEST(FramesAhead, AFrameIsFullOrHasAnEntryAtLeast) {
  EXPECT_EQ(FramesAhead({{.entries = 10, .bits = 500}}, 100), 5);
  EXPECT_EQ(FramesAhead({{.entries = 3, .bits = 500}}, 100), 3);
  EXPECT_EQ(FramesAhead({{.entries = 3, .bits = 500}}, -5), 3) << "any entry leaves it no room";
  EXPECT_EQ(FramesAhead({}, 100), 0);
}

TEST(FramesAhead, AFrequentChannelThatDoesNotFillAFrameNeedsOthersBesideIt) {
  const Ahead commands{.entries = 1000, .bits = 60'000, .most_bits = 60};
  EXPECT_EQ(FramesAhead({commands}, 100), 0);
  EXPECT_EQ(FramesAhead({commands, {.entries = 5, .bits = 400}}, 100), 5);
  EXPECT_EQ(FramesAhead({commands, {.entries = 50, .bits = 400}}, 100), 10);
  EXPECT_EQ(FramesAhead({commands}, 60), 1000) << "alone it leaves no room";
}

/// However a scheduler fills its frames, it needs no more of them than that.
RC_GTEST_PROP(FramesAhead, NoWayToFillFramesTakesMore, ()) {
  const double room = *rc::gen::inRange(20, 200);
  const int newest = *rc::gen::inRange(1, 200), newest_entries = *rc::gen::inRange(0, 40);
  const auto events = *rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 120));
  double bits = 0;
  for (const int e : events) bits += e;
  const double bound = FramesAhead({{.entries = static_cast<double>(newest_entries),
                                     .bits = static_cast<double>(newest_entries * newest),
                                     .most_bits = static_cast<double>(newest)},
                                    {.entries = static_cast<double>(events.size()), .bits = bits}},
                                   room);
  // As wasteful as can be: small entries first, one newest per frame, a frame ends when it is full.
  std::vector<int> left = events;
  std::sort(left.begin(), left.end());
  int frames = 0, used = 0;
  std::size_t next = 0;
  while (true) {
    double in_frame = used < newest_entries ? newest : 0;
    while (in_frame < room && next < left.size()) in_frame += left[next++];
    if (in_frame < room) break;
    ++used;
    ++frames;
  }
  RC_ASSERT(frames <= bound);
}

}  // namespace
}  // namespace priamos::bus::radio
