#include "world/core/head/camera_server.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

namespace priamos::world {
namespace {

constexpr Duration Ms(int ms) {
  return Duration(1000 * ms);
}

/// An executor that keeps the jobs and gives pictures back when the test says so.
class FakeExecutor : public RenderExecutor {
 public:
  void Submit(const RenderJob& job) override { jobs.push_back(job); }
  std::optional<GreyImage> Take(std::int64_t number) override {
    if (!finished.erase(number)) return std::nullopt;
    return GreyImage{2, 1, {static_cast<std::uint8_t>(number), 0}};
  }
  std::vector<RenderJob> jobs;
  std::set<std::int64_t> finished;
};

class CameraServerTest : public ::testing::Test {
 protected:
  CameraServerTest() {
    config_.trigger_delay_s = 0.004;
    config_.exposure_s = 0.008;
    config_.readout_s = 0.040;
  }
  /// Opens and closes the shutter at the moments the server asks for.
  void Expose(CameraServer& dut) {
    for (int i = 0; i < 2; ++i) dut.Sample(Viewpoint{{double(i), 0, 0}, {}});
  }

  static std::vector<Frame> CollectAll(CameraServer& dut, Time now) {
    std::vector<Frame> frames;
    while (auto frame = dut.Collect(now)) frames.push_back(std::move(*frame));
    return frames;
  }

  CameraConfig config_;
  FakeExecutor executor_;
  const Time start_ = FromUtime(1'000'000);
};

TEST_F(CameraServerTest, ASampleIsWantedAtOpeningAndClosing) {
  CameraServer dut(config_, 0, executor_, 1);
  EXPECT_FALSE(dut.NextSample());
  EXPECT_TRUE(dut.Trigger(start_, 7, 3));
  EXPECT_EQ(dut.NextSample(), start_ + Ms(4));
  dut.Sample({{1, 0, 0}, {}});
  EXPECT_EQ(dut.NextSample(), start_ + Ms(12));
  EXPECT_TRUE(executor_.jobs.empty());
  dut.Sample({{2, 0, 0}, {}});
  EXPECT_FALSE(dut.NextSample());
  ASSERT_EQ(executor_.jobs.size(), 2u);
  EXPECT_EQ(executor_.jobs[0].opening.map_from_base.x, 1);
  EXPECT_EQ(executor_.jobs[0].closing.map_from_base.x, 2);
}

TEST_F(CameraServerTest, TheLaserShinesOnlyWhenTheTriggerAsksForIt) {
  config_.laser = 0.6;
  CameraServer dut(config_, 0, executor_, 1);
  for (const int cameras : {4 + 8, 4}) {
    ASSERT_TRUE(dut.Trigger(start_, 7, cameras));
    Expose(dut);
  }
  ASSERT_EQ(executor_.jobs.size(), 2u);
  EXPECT_EQ(executor_.jobs[0].exposure.laser, 0.6);
  EXPECT_EQ(executor_.jobs[1].exposure.laser, 0);
  EXPECT_FALSE(dut.Trigger(start_, 8, 8)) << "a laser is no camera";
}

TEST_F(CameraServerTest, AllCamerasShareOneExposure) {
  CameraServer dut(config_, 0.5, executor_, 1);
  dut.Trigger(start_, 7, 7);
  Expose(dut);
  ASSERT_EQ(executor_.jobs.size(), 3u);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(executor_.jobs[static_cast<std::size_t>(c)].camera, c);
    EXPECT_EQ(executor_.jobs[static_cast<std::size_t>(c)].exposure.camera_light, 0.5);
  }
  EXPECT_NE(executor_.jobs[0].noise_seed, executor_.jobs[1].noise_seed);
}

TEST_F(CameraServerTest, FramesComeAfterTheReadoutWithTheMiddleOfTheExposure) {
  CameraServer dut(config_, 0, executor_, 1);
  dut.Trigger(start_, 7, 2);
  Expose(dut);
  executor_.finished = {0};
  EXPECT_TRUE(CollectAll(dut, start_ + Ms(51)).empty());
  const auto frames = CollectAll(dut, start_ + Ms(52));
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].exposure_middle, start_ + Ms(8));
  EXPECT_EQ(frames[0].frame_id, 7);
  EXPECT_EQ(frames[0].camera, kRightCamera);
  EXPECT_TRUE(CollectAll(dut, start_ + Ms(60)).empty());
}

TEST_F(CameraServerTest, ASlowPictureComesWhenItIsDrawnAndKeepsItsPlace) {
  CameraServer dut(config_, 0, executor_, 1);
  dut.Trigger(start_, 7, 3);
  Expose(dut);
  executor_.finished = {1};
  EXPECT_TRUE(CollectAll(dut, start_ + Ms(400)).empty());
  executor_.finished = {0, 1};
  const auto frames = CollectAll(dut, start_ + Ms(410));
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].camera, kLeftCamera);
  EXPECT_EQ(frames[1].camera, kRightCamera);
  EXPECT_EQ(frames[0].exposure_middle, frames[1].exposure_middle);
}

TEST_F(CameraServerTest, ASecondTriggerDuringAnExposureWaitsForTheShutter) {
  CameraServer dut(config_, 0, executor_, 1);
  dut.Trigger(start_, 1, 1);
  dut.Trigger(start_ + Ms(2), 2, 1);
  Expose(dut);
  EXPECT_GT(*dut.NextSample(), start_ + Ms(12));
  Expose(dut);
  executor_.finished = {0, 1};
  const auto frames = CollectAll(dut, start_ + Ms(100));
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[1].frame_id, 2);
}

TEST_F(CameraServerTest, TooManyPendingPicturesAndNoCameraAreRefused) {
  config_.max_pending = 3;
  CameraServer dut(config_, 0, executor_, 1);
  EXPECT_FALSE(dut.Trigger(start_, 1, 0));
  EXPECT_FALSE(dut.Trigger(start_, 1, 8));
  EXPECT_TRUE(dut.Trigger(start_, 1, 3));
  EXPECT_FALSE(dut.Trigger(start_, 2, 3));
  EXPECT_TRUE(dut.Trigger(start_, 3, 1));
  Expose(dut);
  executor_.finished = {0, 1};
  EXPECT_EQ(CollectAll(dut, start_ + Ms(100)).size(), 2u);
  EXPECT_TRUE(dut.Trigger(start_ + Ms(100), 4, 3));
}

TEST_F(CameraServerTest, EveryPictureHasItsOwnNoiseThatTheSeedDecides) {
  const auto noise = [this](std::uint64_t seed) {
    executor_.jobs.clear();
    CameraServer dut(config_, 0, executor_, seed);
    for (int i = 0; i < 2; ++i) {
      dut.Trigger(start_ + i * Ms(100), 1, 1);
      Expose(dut);
    }
    return std::pair(executor_.jobs[0].noise_seed, executor_.jobs[1].noise_seed);
  };
  EXPECT_EQ(noise(1), noise(1));
  EXPECT_NE(noise(1), noise(2));
  EXPECT_NE(noise(1).first, noise(1).second);
}

TEST_F(CameraServerTest, APictureThatCannotBeDrawnIsLostAndTheNextComes) {
  int drawn = 0;
  InlineRenderExecutor executor([&](const RenderJob&) -> GreyImage {
    if (drawn++ == 0) throw std::runtime_error("out of memory");
    return {1, 1, {0}};
  });
  CameraServer dut(config_, 0, executor, 1);
  dut.Trigger(start_, 7, 3);
  Expose(dut);
  EXPECT_THROW(dut.Collect(start_ + Ms(100)), std::runtime_error);
  const auto frames = CollectAll(dut, start_ + Ms(100));
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].camera, kRightCamera);
}

TEST(InlineRenderExecutorTest, DrawsAtOnceAndGivesEachPictureOnce) {
  InlineRenderExecutor dut([](const RenderJob& job) {
    return GreyImage{1, 1, {static_cast<std::uint8_t>(job.number)}};
  });
  RenderJob job;
  job.number = 5;
  dut.Submit(job);
  EXPECT_FALSE(dut.Take(4));
  ASSERT_TRUE(dut.Take(5).has_value());
  EXPECT_FALSE(dut.Take(5));
}

}  // namespace
}  // namespace priamos::world
