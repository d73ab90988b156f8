#include "world/world_app.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <thread>

#include "bus/own_types.hpp"
#include "common/archive.hpp"
#include "world/world_messages.hpp"

namespace priamos::world {
namespace {

/// Tests run side by side, each in a process of its own, and must not share a frame store.
std::string Instance() {
  return "world-app-test-" + std::to_string(getpid());
}

/// The world on a bus of its own in simulated time, and a robot played by hand.
struct Stage {
  explicit Stage(const std::string& world = "worlds/door.toml", std::uint64_t seed = 1, bool lockstep = true)
      : context{node, Around(seed, lockstep)}, dut(ConfigOf(world), context) {}

  static WorldConfig ConfigOf(const std::string& world) {
    WorldConfig config;
    config.world = world;
    config.lens.sub_exposures = 1;
    return config;
  }
  bus::Surroundings Around(std::uint64_t seed, bool lockstep) {
    bus::Surroundings around;
    around.instance = Instance();
    around.config_dir = PRIAMOS_SOURCE_DIR "/config/sim";
    around.seed = seed;
    around.lockstep = lockstep;
    around.log = [this](bus::Level, std::string_view text) { log.emplace_back(text); };
    return around;
  }
  void Run(double seconds, const PerWheel* wheels = nullptr) {
    for (int i = 0; i < seconds / Seconds(dut.TickPeriod()); ++i) {
      if (wheels && i % 2 == 0) commands.Publish(ToMessage(*wheels, clock.Now()));
      clock.Set(clock.Now() + dut.TickPeriod());
      bus.Drain();
      dut.Tick(clock.Now());
      bus.Drain();
    }
  }

  bus::Schema schema = bus::OwnTypes();
  bus::SimulatedClock clock{FromUtime(1'000'000'000)};
  bus::LcmBus bus{"memq://"};
  bus::Node node{bus, schema, clock}, other{bus, schema, clock};
  std::vector<std::string> log;
  bus::Context context;
  WorldApp dut;
  bus::Publisher<wheel_command_t> commands = other.Advertise(channels::kWheelCommand);
  bus::Publisher<head_command_t> head_commands = other.Advertise(channels::kHeadCommand);
  bus::Publisher<camera_trigger_t> triggers = other.Advertise(channels::kCameraTrigger);
  bus::Inbox<wheel_state_t> wheels = other.SubscribeAll(channels::kWheelState);
  bus::Inbox<sonar_ranges_t> sonars = other.SubscribeAll(channels::kSonarRanges);
  bus::Inbox<head_state_t> heads = other.SubscribeAll(channels::kHeadState);
  bus::Inbox<camera_frame_t> frames = other.SubscribeAll(channels::kCameraFrame);
  bus::Inbox<world_truth_t> truths = other.SubscribeAll(channels::kWorldTruth);
};

TEST(WorldAppTest, SpeaksAtTheRatesOfItsChannels) {
  Stage s;
  s.Run(1);
  EXPECT_NEAR(s.wheels.Drain().size(), 50, 1);
  EXPECT_NEAR(s.heads.Drain().size(), 50, 1);
  EXPECT_NEAR(s.truths.Drain().size(), 50, 1);
  EXPECT_NEAR(s.sonars.Drain().size(), 10, 1);
  EXPECT_TRUE(s.frames.Drain().empty());
}

TEST(WorldAppTest, HasOnlyDeviceChannelsAndTheTruth) {
  Stage s;
  std::vector<std::string> in, out;
  for (const auto& endpoint : s.node.inputs()) in.push_back(endpoint.channel);
  for (const auto& endpoint : s.node.outputs()) out.push_back(endpoint.channel);
  EXPECT_THAT(in, ::testing::UnorderedElementsAre("WHEEL_COMMAND", "HEAD_COMMAND", "CAMERA_TRIGGER"));
  EXPECT_THAT(out,
              ::testing::UnorderedElementsAre("WHEEL_STATE", "MOTOR_CURRENT", "BUMPER", "SONAR_RANGES",
                                              "HEAD_STATE", "CAMERA_FRAME", "WORLD_TRUTH", "WORLD_TOUCH"));
}

TEST(WorldAppTest, StartsWithinTheStatedErrorOfTheNominalPose) {
  Stage s;
  s.Run(0.1);
  const auto truth = s.truths.Drain().front();
  EXPECT_LE(std::hypot(truth.x_m - 2.0, truth.y_m - 2.4), 0.2);
  EXPECT_LE(std::abs(Degrees(truth.yaw_rad)), 5);
  ASSERT_FALSE(s.log.empty());
  EXPECT_THAT(s.log[0], ::testing::HasSubstr("nominal start 2.000 m, 2.400 m"));
}

TEST(WorldAppTest, DrivesOnCommandAndStopsInSilence) {
  Stage s;
  const PerWheel forward{3, 3, 3, 3};
  s.Run(2, &forward);
  auto truths = s.truths.Drain();
  EXPECT_NEAR(truths.back().vx_m_s, 0.3, 0.02);
  EXPECT_FALSE(s.wheels.Drain().back().deadline_stopped);
  s.Run(0.25);
  EXPECT_TRUE(s.wheels.Drain().back().deadline_stopped);
  s.Run(0.5);
  EXPECT_EQ(s.truths.Drain().back().vx_m_s, 0);
}

TEST(WorldAppTest, ObeysNeitherOfTwoThatCommandInTheSameTick) {
  Stage s;
  const PerWheel forward{3, 3, 3, 3}, backward{-3, -3, -3, -3};
  for (int i = 0; i < 100; ++i) {
    s.commands.Publish(ToMessage(forward, s.clock.Now(), 1));
    s.commands.Publish(ToMessage(backward, s.clock.Now(), 2));
    s.Run(0.02);
  }
  EXPECT_EQ(s.truths.Drain().back().vx_m_s, 0);
  const wheel_state_t state = s.wheels.Drain().back();
  EXPECT_TRUE(state.contested);
  EXPECT_EQ(state.instance, 1);
  EXPECT_NEAR(state.foreign_commands, 100, 2);
  EXPECT_THAT(s.log, ::testing::Contains(::testing::HasSubstr("two processes command the wheels")));
}

TEST(WorldAppTest, MovesTheHead) {
  Stage s;
  s.head_commands.Publish(ToMessage(HeadSetting{0.1745, 0, {0, 0}, {650, 650}, {1600, 1600}}, s.clock.Now()));
  s.Run(0.2);
  EXPECT_TRUE(s.heads.Drain().back().moving);
  s.Run(0.6);
  const auto head = s.heads.Drain().back();
  EXPECT_FALSE(head.moving);
  EXPECT_NEAR(head.pan_rad, 0.1745, 1e-4);
  EXPECT_NEAR(s.truths.Drain().back().pan_rad, 0.1745, 0.001);
}

TEST(WorldAppTest, ATriggerBringsAStereoPairIntoTheFrameStore) {
  Stage s;
  const auto store = FrameStore::Attach(Instance() + "-camera");
  ASSERT_TRUE(store);
  camera_trigger_t trigger{};
  trigger.utime = ToUtime(s.clock.Now());
  trigger.frame_id = 77;
  trigger.cameras = 3;
  s.triggers.Publish(trigger);
  const Time asked = s.clock.Now() + s.dut.TickPeriod();
  s.Run(0.2);
  const auto frames = s.frames.Drain();
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].utime_exposure, frames[1].utime_exposure);
  EXPECT_EQ(FromUtime(frames[0].utime_exposure), asked + Duration(8000));
  for (const auto& frame : frames) {
    const auto image = store->Read(frame.slot, 77);
    ASSERT_TRUE(image);
    EXPECT_EQ(image->width, 768);
    EXPECT_EQ(image->height, 576);
    const auto [dark, bright] = std::minmax_element(image->pixels.begin(), image->pixels.end());
    EXPECT_GT(*bright - *dark, 60) << "an evenly grey picture of a furnished room";
  }
  EXPECT_NE(store->Read(frames[0].slot, 77)->pixels, store->Read(frames[1].slot, 77)->pixels);
}

TEST(WorldAppTest, InRealTimeTheSamePicturesComeFromAThread) {
  const auto pictures = [](bool lockstep) {
    Stage s("worlds/door.toml", 3, lockstep);
    const auto store = FrameStore::Attach(Instance() + "-camera");
    camera_trigger_t trigger{};
    trigger.utime = ToUtime(s.clock.Now());
    trigger.frame_id = 5;
    trigger.cameras = 3;
    s.triggers.Publish(trigger);
    std::vector<std::vector<std::uint8_t>> all;
    double reports = 0;  // drained at once: drawing may take longer than an inbox holds
    while (all.size() < 2) {
      s.Run(0.01);
      reports += static_cast<double>(s.wheels.Drain().size());
      for (const auto& frame : s.frames.Drain()) all.push_back(store->Read(frame.slot, 5)->pixels);
      std::this_thread::yield();
    }
    // However long drawing took: the devices kept their rates.
    EXPECT_NEAR(reports, Seconds(s.clock.Now() - FromUtime(1'000'000'000)) * 50, 1.5);
    return all;
  };
  EXPECT_EQ(pictures(true), pictures(false));
}

TEST(WorldAppTest, TheSameSeedGivesTheSameMessages) {
  const auto run = [](std::uint64_t seed) {
    Stage s("worlds/door.toml", seed);
    const PerWheel forward{3, 3, 3, 3};
    s.Run(1, &forward);
    std::vector<std::byte> all;
    for (const auto& m : s.wheels.Drain())
      for (const auto b : bus::Encode(m)) all.push_back(b);
    for (const auto& m : s.sonars.Drain())
      for (const auto b : bus::Encode(m)) all.push_back(b);
    for (const auto& m : s.truths.Drain())
      for (const auto b : bus::Encode(m)) all.push_back(b);
    return all;
  };
  const auto first = run(5);
  EXPECT_EQ(first, run(5));
  EXPECT_NE(first, run(6));
}

TEST(WorldAppTest, AnUnknownWorldIsASentence) {
  try {
    Stage s("worlds/nowhere.toml");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("nowhere.toml"));
  }
}

}  // namespace
}  // namespace priamos::world
