#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "bus/radio/budget.hpp"
#include "bus/radio/line/packet_air.hpp"
#include "link_pair.hpp"

namespace priamos::bus::radio {
namespace {

const Time kStart = FromUtime(1'000'000'000);
constexpr Duration kTick{1000};
constexpr double kLatency_s = 0.005;

/// A radio and what its channels may ask of it.
struct Radio {
  const char* name;
  LinkOptions options;
  double hours;
  double unit_s;  ///< mean time between the messages of the slowest channel
  Duration ttl{3'000'000};
};

LinkOptions Packets(double bytes_per_s, Duration overhead, std::size_t packet, std::size_t bundle,
                    HalfDuplex half_duplex, Duration keep_alive) {
  return {.bytes_per_s = bytes_per_s,
          .max_bundle_bytes = bundle,
          .keep_alive = keep_alive,
          .silence = 6 * keep_alive,
          .half_duplex = half_duplex,
          .line_delay = FromSeconds(2 * kLatency_s),
          .datagrams = true,
          .packet_overhead = overhead,
          .packet_bytes = packet};
}

/// Channels of all classes, at rates of about one message per `unit_s`.
std::vector<LinkChannel> ChannelsFor(double unit_s, Duration ttl) {
  std::vector<LinkChannel> channels = TestChannels();
  for (LinkChannel& c : channels) {
    c.rate_hz = 1 / unit_s;
    c.ttl = c.channel_class == ChannelClass::kCommand ? ttl : Duration::zero();
    if (c.max_bits > 8 * 100) c.max_bits = 8 * 40;
    if (c.fixed_bits > 8 * 20) c.fixed_bits = c.max_bits = 8 * 20;
  }
  return channels;
}

/// Two ends and the air between them.
class PacketWorld {
 public:
  PacketWorld(const Radio& radio, double loss, std::uint64_t seed)
      : radio_(radio),
        rng_(Rng::Stream(seed, "packets")),
        air_({.bytes_per_s = radio.options.bytes_per_s,
              .overhead_s = Seconds(radio.options.packet_overhead),
              .latency_s = kLatency_s,
              .loss = loss,
              .half_duplex = radio.options.half_duplex.turn > Duration::zero()},
             Rng::Stream(seed, "air"), kStart) {
    channels_ = ChannelsFor(radio.unit_s, radio.ttl);
    for (End& end : ends_)
      end.link = std::make_unique<LinkEndpoint>(
          ChannelTable(channels_, false), end.outgoing, LinkKey{1, 2, 3}, radio.options, end.store,
          [](std::size_t, std::span<const std::byte> encoded, Time) {
            return std::optional(Packed{{encoded.begin(), encoded.end()}, encoded.size() * 8});
          },
          [this] { return rng_.engine()(); }, now_);
  }

  void Run(double seconds, bool offer) {
    for (const Time end = now_ + FromSeconds(seconds); now_ < end; now_ += kTick) {
      if (offer) Offer();
      for (std::size_t side = 0; side < 2; ++side) Send(side);
      for (std::size_t side = 0; side < 2; ++side) Receive(side);
    }
  }
  const std::vector<LinkChannel>& channels() const { return channels_; }
  std::size_t collisions() const { return air_.collisions(); }

  /// Largest share of a window of this length that one end was on the air.
  double LargestShare(Duration window) const {
    double largest = 0;
    for (const End& end : ends_) {
      Duration inside{};
      for (std::size_t first = 0, last = 0; last < end.on_air.size(); ++last) {
        inside += end.on_air[last].second - end.on_air[last].first;
        for (; end.on_air[last].second - end.on_air[first].first > window; ++first)
          inside -= end.on_air[first].second - end.on_air[first].first;
        largest = std::max(largest, Seconds(inside) / Seconds(window));
      }
    }
    return largest;
  }

  std::map<std::size_t, Duration> worst;
  std::map<std::size_t, std::size_t> offered, received;
  std::size_t longest_packet = 0, overlaps = 0;

 private:
  struct End {
    Direction outgoing;
    MemoryStore store{};
    std::unique_ptr<LinkEndpoint> link{};
    std::vector<std::pair<Time, Time>> on_air{};  ///< its packets
  };

  void Offer() {
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      const LinkChannel& c = channels_[i];
      const Time due = kStart + FromSeconds(radio_.unit_s * (1 + 0.13 * static_cast<double>(i)));
      Time& next = next_.try_emplace(i, due).first->second;
      if (now_ < next) continue;
      // Never sooner than the rate allows, at times that drift over each other.
      next = now_ + FromSeconds(rng_.Uniform(1.0, 1.6) * radio_.unit_s);
      std::vector<std::byte> message(c.max_bits / 8);
      const std::size_t number = offered[i]++;
      for (std::size_t b = 0; b < std::min<std::size_t>(4, message.size()); ++b)
        message[b] = static_cast<std::byte>(number >> 8 * b);
      End& end = c.direction == Direction::kUp ? ends_[0] : ends_[1];
      ASSERT_EQ(end.link->Offer(i, message, now_), OfferResult::kAccepted);
      at_[i].push_back(now_);
    }
  }

  void Send(std::size_t side) {
    std::vector<std::byte> frame;
    for (const std::byte b : ends_[side].link->Step(now_)) {
      frame.push_back(b);
      if (b == kDelimiter) Transmit(side, std::exchange(frame, {}));
    }
    ASSERT_TRUE(frame.empty()) << "a frame was left half sent";
  }

  void Transmit(std::size_t side, std::vector<std::byte> frame) {
    longest_packet = std::max(longest_packet, frame.size());
    const Time free = air_.free_at(side);
    overlaps += free > now_ + Duration(4000) + FromSeconds(4 / radio_.options.bytes_per_s);
    air_.Send(side, std::move(frame), now_);
    ends_[side].on_air.push_back({std::max(free, now_), air_.free_at(side)});
  }

  void Receive(std::size_t side) {
    for (const std::vector<std::byte>& packet : air_.Receive(side, now_)) {
      const auto content = std::span(packet).first(packet.size() - 1);
      for (const Delivery& d : ends_[side].link->ReceiveFrame(content, now_, now_, false).deliveries) Note(d);
    }
  }

  void Note(const Delivery& d) {
    if (channels_[d.channel].channel_class == ChannelClass::kEvent) {
      // Exactly once, in order.
      const std::size_t number = received[d.channel]++;
      ASSERT_EQ(d.packed.at(0), static_cast<std::byte>(number)) << channels_[d.channel].name;
      ASSERT_LT(number, at_[d.channel].size());
      Measure(d.channel, at_[d.channel][number]);
      return;
    }
    std::size_t number = 0;
    for (std::size_t b = 0; b < 4; ++b) number |= std::to_integer<std::size_t>(d.packed.at(b)) << 8 * b;
    ++received[d.channel];
    if (channels_[d.channel].channel_class == ChannelClass::kCommand) {
      EXPECT_LE(now_ - at_[d.channel].at(number), radio_.ttl);
    }
    Measure(d.channel, at_[d.channel].at(number));
  }

  void Measure(std::size_t channel, Time offered_at) {
    const Duration took = now_ - offered_at - FromSeconds(kLatency_s);
    worst[channel] = std::max(worst[channel], took);
  }

  Radio radio_;
  Rng rng_;
  PacketAir air_;
  Time now_ = kStart;
  std::vector<LinkChannel> channels_;
  End ends_[2] = {{.outgoing = Direction::kUp}, {.outgoing = Direction::kDown}};
  std::map<std::size_t, Time> next_;
  std::map<std::size_t, std::vector<Time>> at_;
};

Radio DutyCycleRadio() {
  Radio radio{"TwoChannelsDuty10", Packets(684, Duration(20'000), 222, 80, {}, Duration(2'000'000)), 3, 60,
              Duration(20'000'000)};
  radio.options.duty = DutyCycle(0.1, FromSeconds(600));
  return radio;
}

std::vector<Radio> Radios() {
  return {
      {"LoRaSF7",
       Packets(684, Duration(20'000), 222, 120, {Duration(900'000), Duration(20'000)}, Duration(1'000'000)),
       1.5, 20},
      {"TwoChannelsSF7", Packets(684, Duration(20'000), 222, 120, {}, Duration(500'000)), 1, 8},
      {"Fast20k",
       Packets(2500, Duration(5'000), 250, 120, {Duration(400'000), Duration(5'000)}, Duration(500'000)), 0.7,
       8},
      DutyCycleRadio()};
}

class PacketRadio : public testing::TestWithParam<Radio> {};

TEST_P(PacketRadio, NoMessageIsLaterThanItsBound) {
  PacketWorld dut(GetParam(), 0, 7);
  dut.Run(20, false);
  const std::size_t collisions = dut.collisions();
  dut.Run(GetParam().hours * 3600, true);
  dut.Run(60, false);
  const Budget budget = ComputeBudget(ChannelTable(dut.channels(), false), GetParam().options);
  ASSERT_TRUE(budget.problems.empty()) << budget.problems.front();
  for (const DirectionBudget* d : {&budget.up, &budget.down}) {
    EXPECT_LE(dut.longest_packet, GetParam().options.packet_bytes);
    for (const ChannelBudget& row : d->channels) {
      ASSERT_TRUE(row.worst_latency) << dut.channels()[row.channel].name;
      EXPECT_GT(dut.received[row.channel], 100U);
      EXPECT_EQ(dut.received[row.channel], dut.offered[row.channel]);
      EXPECT_LE(Seconds(dut.worst[row.channel]), Seconds(*row.worst_latency) + 0.002)
          << dut.channels()[row.channel].name;
    }
  }
  EXPECT_EQ(dut.overlaps, 0U);
  EXPECT_EQ(dut.collisions(), collisions);
  if (GetParam().options.duty.limited()) {
    EXPECT_LE(dut.LargestShare(FromSeconds(600)), 0.1);
  }
}

TEST_P(PacketRadio, EventsComeExactlyOnceWhereOnePacketInFiveIsLost) {
  PacketWorld dut(GetParam(), 0.2, 11);
  dut.Run(std::max(600.0, 30 * GetParam().unit_s), true);
  dut.Run(300, false);
  for (std::size_t i = 0; i < dut.channels().size(); ++i)
    if (dut.channels()[i].channel_class == ChannelClass::kEvent) {
      EXPECT_GT(dut.received[i], 10U);
      EXPECT_EQ(dut.received[i], dut.offered[i]) << dut.channels()[i].name;
    }
}

INSTANTIATE_TEST_SUITE_P(Radios, PacketRadio, testing::ValuesIn(Radios()),
                         [](const auto& radio) { return std::string(radio.param.name); });

/// An operator who hits the stop again and again, and nobody who answers: the law holds all the same.
TEST(PacketRadioDuty, HoldsHoweverManyStopsWait) {
  Radio radio = DutyCycleRadio();
  PacketWorld dut(radio, 0.9, 3);
  for (int i = 0; i < 20; ++i) {
    dut.Run(60, true);
    dut.Run(60, false);
  }
  EXPECT_GT(dut.LargestShare(FromSeconds(600)), 0.05) << "nothing was tried";
  EXPECT_LE(dut.LargestShare(FromSeconds(600)), 0.1);
}

TEST(PacketBudget, RefusesWhatTheDutyCycleCannotCarry) {
  LinkOptions options = DutyCycleRadio().options;
  const auto problem_of = [&] {
    const Budget budget = ComputeBudget(ChannelTable(ChannelsFor(60, Duration(20'000'000)), false), options);
    return budget.problems.empty() ? "" : budget.problems.front();
  };
  EXPECT_EQ(problem_of(), "");
  options.duty = DutyCycle(0.1, FromSeconds(10));
  EXPECT_NE(problem_of().find("duty_cycle: expected packets of at most"), std::string::npos) << problem_of();
  options.duty = DutyCycle(0.1, FromSeconds(24));
  EXPECT_NE(problem_of().find("expected urgent messages that take at most"), std::string::npos)
      << problem_of();
  options = DutyCycleRadio().options;
  options.silence = Duration(1'000'000);
  EXPECT_NE(problem_of().find("silence_s: radio link up: expected at least"), std::string::npos)
      << problem_of();
  options = DutyCycleRadio().options;
  options.duty = DutyCycle(0.01, FromSeconds(6000));
  EXPECT_NE(problem_of(), "") << "a tenth of the air for the same messages";
}

TEST(PacketBudget, RefusesAFrameThatNoPacketHolds) {
  LinkOptions options = Radios().front().options;
  options.packet_bytes = 100;
  const Budget budget = ComputeBudget(ChannelTable(ChannelsFor(20, Duration(3'000'000)), false), options);
  ASSERT_FALSE(budget.problems.empty());
  EXPECT_NE(budget.problems.front().find("expected frames of at most 100 byte, the mtu_bytes"),
            std::string::npos)
      << budget.problems.front();
}

}  // namespace
}  // namespace priamos::bus::radio
