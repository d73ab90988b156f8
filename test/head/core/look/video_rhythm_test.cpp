#include "head/core/look/video_rhythm.hpp"

#include <gtest/gtest.h>

#include "head/core/camera/head_model.hpp"

namespace priamos::head {
namespace {

FrameNotice Third(std::int32_t frame_id) {
  FrameNotice frame;
  frame.frame_id = frame_id;
  frame.camera = kThird;
  return frame;
}

class VideoRhythmTest : public testing::Test {
 protected:
  /// Exposures within a second of which every picture comes.
  int Expose(bool watched, bool needed) {
    int exposures = 0;
    for (int i = 0; i < 50; ++i) {
      now_ += FromSeconds(0.02);
      if (!dut_.Step(watched, needed, now_)) continue;
      ++exposures;
      EXPECT_TRUE(dut_.Takes(Third(dut_.frame_id())));
    }
    return exposures;
  }

  VideoRhythm dut_{5};
  Time now_{std::chrono::seconds(100)};
};

TEST_F(VideoRhythmTest, ExposesWhileSomebodyLooksAndNoLookNeedsTheCameras) {
  EXPECT_EQ(Expose(false, false), 0);
  EXPECT_EQ(Expose(true, false), 5);
  EXPECT_EQ(Expose(true, true), 0);
  EXPECT_EQ(Expose(true, false), 5);
}

TEST_F(VideoRhythmTest, WaitsForAPictureThatIsLateAndGivesItUp) {
  ASSERT_TRUE(dut_.Step(true, false, now_));
  EXPECT_FALSE(dut_.Step(true, false, now_ + FromSeconds(0.9)));
  EXPECT_TRUE(dut_.Step(true, false, now_ + FromSeconds(1.1)));
}

TEST_F(VideoRhythmTest, TakesItsOwnPictureOnce) {
  ASSERT_TRUE(dut_.Step(true, false, now_));
  FrameNotice left = Third(dut_.frame_id());
  left.camera = kLeft;
  EXPECT_FALSE(dut_.Takes(left));
  EXPECT_FALSE(dut_.Takes(Third(dut_.frame_id() + 1)));
  EXPECT_TRUE(dut_.Takes(Third(dut_.frame_id())));
  EXPECT_FALSE(dut_.Takes(Third(dut_.frame_id())));
}

}  // namespace
}  // namespace priamos::head
