#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bus/radio/line/shared_line.hpp"
#include "bus/radio/shared_budget.hpp"
#include "bus/radio/station.hpp"
#include "test/bus/radio/link_pair.hpp"

namespace priamos::bus::radio {

/// Channels of each robot: a pose, a fault, driving, stops and an order.
enum SharedTestChannel : std::size_t { kSharedPose, kSharedFault, kSharedDrive, kSharedStop, kSharedOrder };

inline std::vector<LinkChannel> SharedTestChannels() {
  std::vector<LinkChannel> channels{
      TestChannelOf("POSE", Direction::kUp, ChannelClass::kState, 132, 2, 1),
      TestChannelOf("FAULT", Direction::kUp, ChannelClass::kEvent, 32, 1, 0.05),
      TestChannelOf("DRIVE", Direction::kDown, ChannelClass::kCommand, 40, 1, 20),
      TestChannelOf("STOP", Direction::kDown, ChannelClass::kEvent, 14, 0, 0.05),
      TestChannelOf("ORDER", Direction::kDown, ChannelClass::kEvent, 48, 3, 0.05)};
  channels[kSharedDrive].ttl = std::chrono::milliseconds(600);
  channels[kSharedStop].urgent = true;
  return channels;
}

inline LinkOptions SharedTestOptions(std::uint8_t robots) {
  return {.max_bundle_bytes = 23,
          .half_duplex = {.turnaround = Duration(20'000)},
          .line_delay = Duration(2'000),
          .robots = robots,
          .grace = Duration(3'000)};
}

/// A station and robots on one emulated channel, in simulated time.
class SharedWorld {
 public:
  struct Received {
    Time at;
    std::size_t robot;
    Delivery delivery;
  };
  struct End {
    MemoryStore store;
    std::unique_ptr<LinkEndpoint> link;
  };

  explicit SharedWorld(std::uint8_t robots, std::uint64_t seed = 1, LineConfig line = {.latency_s = 0.001})
      : options(SharedTestOptions(robots)),
        air(line, robots + std::size_t{1}, seed, now),
        robots_(robots),
        at_station_(robots),
        nonces_(Rng::Stream(seed, "nonces")) {
    for (std::size_t i = 0; i < robots; ++i) {
      Start(robots_[i], Direction::kUp, i);
      Start(at_station_[i], Direction::kDown, i);
    }
    StartStation();
  }

  /// Starts the robot's end, as a new process would.
  void StartRobot(std::size_t robot) { Start(robots_[robot], Direction::kUp, robot); }
  void StopRobot(std::size_t robot) { robots_[robot].link.reset(); }
  MemoryStore& StoreOf(std::size_t robot) { return robots_[robot].store; }
  LinkEndpoint* robot(std::size_t i) { return robots_[i].link.get(); }
  LinkEndpoint& at_station(std::size_t i) { return *at_station_[i].link; }

  /// Lets the process of a robot, or of the station (kStationStalls), stand still from now on.
  void Stall(std::size_t robot, Duration length) { stalled_until_[robot] = now + length; }

  void StepOnce() {
    now += Duration(1000);
    if (now >= stalled_until_[kStationStalls]) StepStation();
    for (std::size_t i = 0; i < robots_.size(); ++i)
      if (now >= stalled_until_[i]) StepRobot(i);
  }
  void Run(double seconds, const std::function<void()>& each = {}) {
    for (const Time end = now + FromSeconds(seconds); now < end;) {
      if (each) each();
      StepOnce();
    }
  }

  Time now = FromUtime(1'000'000'000);
  LinkOptions options;
  SharedLine air;
  std::vector<Received> up, down;

  static constexpr std::size_t kStationStalls = 8;

 private:
  void StepStation() {
    air.Write(0, station_->Step(now), now);
    station_->Receive(air.Read(0, now), now, [&](std::size_t robot, Delivery d) {
      up.push_back({now, robot, std::move(d)});
    });
    station_->OnLook(now);
  }
  void StepRobot(std::size_t i) {
    const std::vector<std::byte> heard = air.Read(i + 1, now);
    if (!robots_[i].link) return;
    LinkEndpoint& link = *robots_[i].link;
    air.Write(i + 1, link.Step(now), now);
    for (Delivery& d : link.Receive(heard, now)) down.push_back({now, i, std::move(d)});
    link.OnLook(now);
  }
  void Start(End& end, Direction outgoing, std::size_t robot) {
    LinkOptions own = options;
    own.address = static_cast<std::uint8_t>(robot + 1);
    end.link = std::make_unique<LinkEndpoint>(
        ChannelTable(SharedTestChannels(), false), outgoing, LinkKey{static_cast<std::uint8_t>(robot + 1)},
        own, end.store,
        [](std::size_t channel, std::span<const std::byte> encoded, Time) {
          return std::optional(
              Packed{{encoded.begin(), encoded.end()}, SharedTestChannels()[channel].fixed_bits});
        },
        [this] { return nonces_.engine()(); }, now);
  }
  void StartStation() {
    std::vector<LinkEndpoint*> ends;
    for (End& end : at_station_) ends.push_back(end.link.get());
    station_.emplace(SharedChannelOf(ChannelTable(SharedTestChannels(), false), options), ends);
  }

  std::vector<End> robots_, at_station_;
  std::optional<Station> station_;
  std::array<Time, kStationStalls + 1> stalled_until_{};
  Rng nonces_;
};

/// A message of so many bytes that holds a number.
inline std::vector<std::byte> Numbered(std::size_t bytes, std::uint64_t number) {
  std::vector<std::byte> message(bytes);
  for (std::size_t i = 0; i < std::min<std::size_t>(4, bytes); ++i)
    message[i] = static_cast<std::byte>(number >> 8 * i);
  return message;
}
}  // namespace priamos::bus::radio
