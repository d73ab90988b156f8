#include <gtest/gtest.h>

#include <array>
#include <string>

#include "bus/radio/budget.hpp"
#include "test/bus/radio/shared/shared_traffic.hpp"

// Whose turn it is on a shared channel: no turn comes later than computed, and nobody talks in another's.

namespace priamos::bus::radio {
namespace {

constexpr std::size_t kRobots = 4;

/// Longest time from the end of a turn of each robot to that of its next one.
class TurnWatch {
 public:
  explicit TurnWatch(SharedWorld& world) : world_(world) { ended_.fill(world.now); }
  void Look() {
    for (std::size_t i = 0; i < kRobots; ++i) {
      const bool mine = world_.robot(i)->turns().mine();
      if (had_[i] && !mine) {
        longest_[i] = std::max<Duration>(longest_[i], world_.now - ended_[i]);
        ended_[i] = world_.now;
      }
      had_[i] = mine;
    }
  }
  Duration longest(std::size_t robot) const { return longest_[robot]; }

 private:
  SharedWorld& world_;
  std::array<bool, kRobots> had_{};
  std::array<Time, kRobots> ended_{};
  std::array<Duration, kRobots> longest_{};
};

/// Every end has a full frame to send, one robot is driven, and stops to all come often.
class BusyChannel {
 public:
  explicit BusyChannel(std::uint64_t seed) : world(kRobots, seed), rng_(Rng::Stream(seed, "busy")) {
    world.Run(5);
  }
  void Run(double seconds, bool stops, const std::function<void()>& each) {
    world.Run(seconds, [&] {
      const std::int64_t ms = ToUtime(world.now) / 1000;
      for (std::size_t i = 0; i < kRobots && ms % 20 == 0; ++i) {
        world.robot(i)->Offer(kSharedPose, Numbered(17, 1), world.now);
        if (world.robot(i)->waiting(kSharedFault) < 3)
          world.robot(i)->Offer(kSharedFault, Numbered(4, 1), world.now);
        if (world.at_station(i).waiting(kSharedOrder) < 3)
          world.at_station(i).Offer(kSharedOrder, Numbered(6, 1), world.now);
      }
      if (ms % 50 == 0) world.at_station(0).Offer(kSharedDrive, Numbered(5, 1), world.now);
      if (stops && world.now >= next_stop_) StopAll();
      each();
    });
  }
  SharedWorld world;

 private:
  void StopAll() {
    next_stop_ = world.now + FromSeconds(rng_.Uniform(1.5, 2.0));
    for (std::size_t i = 0; i < kRobots; ++i)
      world.at_station(i).Offer(kSharedStop, Numbered(2, 1), world.now);
  }
  Rng rng_;
  Time next_stop_{};
};

TEST(StationSlots, NoTurnComesLaterThanComputedBesideStopsToAll) {
  std::array<Duration, kRobots> without{};
  for (const bool stops : {false, true}) {
    BusyChannel dut(21);
    const PollBounds bounds =
        ComputeBudget(ChannelTable(SharedTestChannels(), false), dut.world.options).polls;
    ASSERT_TRUE(bounds.busy_cycle && bounds.busy_asked);
    TurnWatch turns(dut.world);
    dut.Run(150, stops, [&] { turns.Look(); });
    for (std::size_t i = 0; i < kRobots; ++i) {
      const bool driven = i == 0;
      const Duration quiet = driven ? bounds.asked : bounds.cycle;
      const Duration busy = driven ? *bounds.busy_asked : *bounds.busy_cycle;
      EXPECT_LE(turns.longest(i), stops ? busy : quiet) << i;
      if (!stops) without[i] = turns.longest(i);
      EXPECT_TRUE(!stops || turns.longest(i) > without[i] + Duration(50'000))
          << i << ": they came in between";
      RecordProperty("robot_" + std::to_string(i) + (stops ? "_beside_stops_ms" : "_ms"),
                     static_cast<int>(turns.longest(i).count() / 1000));
    }
  }
}

/// A robot, or the station, that stands still now and then costs its own turns at most.
TEST(StationSlots, NobodyTalksInAnothersTurnAfterItStoodStill) {
  for (const std::size_t who : {std::size_t{1}, SharedWorld::kStationStalls}) {
    BusyChannel dut(23);
    Rng rng = Rng::Stream(23, "stalls");
    Time next = dut.world.now;
    std::size_t within_an_answer = 0;
    dut.Run(60, false, [&] {
      if (dut.world.now < next) return;
      next = dut.world.now + FromSeconds(rng.Uniform(0.06, 0.3));
      within_an_answer += dut.world.robot(1)->turns().mine() ? 1 : 0;
      dut.world.Stall(who, FromSeconds(rng.Uniform(0.01, 0.06)));
    });
    EXPECT_GT(within_an_answer, 10U);
    for (std::size_t i = 0; i < kRobots; ++i) {
      if (i == who) continue;
      EXPECT_EQ(dut.world.at_station(i).Status(dut.world.now).counters.frames_missed, 0U) << who << " " << i;
      EXPECT_EQ(dut.world.robot(i)->Status(dut.world.now).counters.frames_missed, 0U) << who << " " << i;
    }
  }
}

}  // namespace
}  // namespace priamos::bus::radio
