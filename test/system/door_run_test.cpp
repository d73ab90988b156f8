#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "bus/own_types.hpp"
#include "cli/lockstep/lockstep_run.hpp"

// The whole system in one process on simulated time: world, robot, head, planner and both ends of the radio.

namespace priamos::cli {
namespace {

const std::string kDeployment = std::string(PRIAMOS_SOURCE_DIR) + "/config/sim";

/// A digest of everything on both buses, in order.
struct Digest {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  std::size_t events = 0;
  void Add(std::string_view bus, Time now, std::string_view channel, std::span<const std::byte> bytes) {
    Mix(bus.data(), bus.size());
    const auto utime = ToUtime(now);
    Mix(&utime, sizeof utime);
    Mix(channel.data(), channel.size());
    Mix(bytes.data(), bytes.size());
    ++events;
  }
  void Mix(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 0x100000001b3ULL;
  }
};

LockstepRequest Request(std::uint64_t seed) {
  LockstepRequest request;
  request.deployment = kDeployment;
  request.seed = seed;
  return request;
}

TEST(DoorRun, PassesTheDoorWithoutTouchingIt) {
  const bus::Schema schema = bus::OwnTypes();
  const auto dut = RunLockstep(schema, Request(1));
  EXPECT_TRUE(dut.summary.passed) << dut.summary.reason;
  EXPECT_EQ(dut.summary.contacts, 0);
  EXPECT_GT(dut.summary.min_gap_m, 0);
  EXPECT_GE(dut.summary.fixes.size(), 2u);
}

TEST(DoorRun, SameSeedGivesIdenticalBytesOnBothBuses) {
  const bus::Schema schema = bus::OwnTypes();
  Digest digests[2];
  for (auto& digest : digests) {
    auto request = Request(2);
    request.tap = [&](std::string_view bus, Time now, std::string_view channel,
                      std::span<const std::byte> bytes) { digest.Add(bus, now, channel, bytes); };
    RunLockstep(schema, request);
  }
  EXPECT_GT(digests[0].events, 1000u);
  EXPECT_EQ(digests[0].hash, digests[1].hash);
}

std::set<std::string> SharedMemory() {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator("/dev/shm"))
    if (entry.path().filename().string().starts_with("priamos-")) names.insert(entry.path());
  return names;
}

TEST(DoorRun, WhoIsInterruptedLeavesNoSharedMemory) {
  const bus::Schema schema = bus::OwnTypes();
  const std::set<std::string> before = SharedMemory();
  std::set<std::string> during;
  auto request = Request(1);
  request.interrupted = [&, times = 0]() mutable {
    during = SharedMemory();
    return ++times > 50;
  };
  EXPECT_THROW(RunLockstep(schema, request), Interrupted);
  EXPECT_GT(during.size(), before.size()) << "the cameras' pictures";
  EXPECT_EQ(SharedMemory(), before);
}

TEST(DoorRun, NothingButParametersIsEverOnABus) {
  const bus::Schema schema = bus::OwnTypes();
  std::set<std::string> offboard_channels;
  std::size_t largest = 0, unknown = 0;
  auto request = Request(3);
  request.tap = [&](std::string_view bus, Time, std::string_view channel, std::span<const std::byte> bytes) {
    largest = std::max(largest, bytes.size());
    unknown += schema.Of(bytes) == nullptr;
    if (bus == "offboard") offboard_channels.insert(std::string(channel));
  };
  RunLockstep(schema, request);
  EXPECT_LE(largest, 1400u);
  EXPECT_EQ(unknown, 0u);
  // The offboard side knows nothing of the device channels, and nobody but the report knows the truth.
  for (const char* channel : {"WORLD_TRUTH", "SONAR_RANGES", "WHEEL_STATE", "CAMERA_FRAME", "ODOMETRY"})
    EXPECT_FALSE(offboard_channels.contains(channel)) << channel;
  EXPECT_TRUE(offboard_channels.contains("POSE"));
}

}  // namespace
}  // namespace priamos::cli
