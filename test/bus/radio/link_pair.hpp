#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bus/radio/line/line.hpp"
#include "bus/radio/link.hpp"
#include "bus/radio/link_state.hpp"

namespace priamos::bus::radio {

inline std::vector<std::byte> Text(const std::string& text) {
  std::vector<std::byte> bytes;
  for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
  return bytes;
}
inline std::string ToText(std::span<const std::byte> bytes) {
  std::string text;
  for (const std::byte b : bytes) text += static_cast<char>(b);
  return text;
}

/// Channels of the tests; the packed form of a message is the message.
enum TestChannel : std::size_t { kPoseUp, kEventUp, kSlowUp, kDriveDown, kStopDown, kEventDown };

/// A channel whose messages have so many bits, or with 0 any up to 1400 bytes.
inline LinkChannel TestChannelOf(std::string name, Direction direction, ChannelClass channel_class,
                                 std::uint32_t fixed_bits, int priority, double rate_hz) {
  LinkChannel c;
  c.name = std::move(name);
  c.direction = direction;
  c.channel_class = channel_class;
  c.fixed_bits = fixed_bits;
  c.max_bits = fixed_bits > 0 ? fixed_bits : 8 * 1400;
  c.priority = priority;
  c.rate_hz = rate_hz;
  return c;
}

inline std::vector<LinkChannel> TestChannels() {
  const auto channel = [](std::string name, Direction direction, ChannelClass channel_class,
                          std::uint32_t fixed_bytes, int priority, double rate_hz) {
    return TestChannelOf(std::move(name), direction, channel_class, 8 * fixed_bytes, priority, rate_hz);
  };
  std::vector<LinkChannel> channels{channel("POSE", Direction::kUp, ChannelClass::kState, 10, 2, 10),
                                    channel("EVENT_UP", Direction::kUp, ChannelClass::kEvent, 0, 3, 0),
                                    channel("SLOW", Direction::kUp, ChannelClass::kState, 100, 5, 1),
                                    channel("DRIVE", Direction::kDown, ChannelClass::kCommand, 5, 1, 20),
                                    channel("STOP", Direction::kDown, ChannelClass::kEvent, 1, 0, 0),
                                    channel("EVENT_DOWN", Direction::kDown, ChannelClass::kEvent, 0, 3, 0)};
  channels[kPoseUp].ttl = std::chrono::milliseconds(500);
  channels[kDriveDown].ttl = std::chrono::milliseconds(250);
  channels[kStopDown].urgent = true;
  return channels;
}

/// Two endpoints on an emulated line in simulated time.
class LinkPair {
 public:
  struct Received {
    Time at;
    Delivery delivery;
  };

  struct End {
    explicit End(Direction direction) : outgoing(direction) {}
    Direction outgoing;
    MemoryStore store;
    StateStore* other_store = nullptr;  ///< used instead of `store`
    std::vector<LinkChannel> channels = TestChannels();
    LinkKey key{1, 2, 3};
    std::optional<LinkKey> next_key;
    LinkOptions options;
    std::size_t code_bytes = kShortCodeBytes;
    bool nonces_have_time = true;  ///< else it has no clock
    std::unique_ptr<LinkEndpoint> link;
    std::vector<Received> received;
    std::vector<std::string> TextsOf(std::size_t channel) const {
      std::vector<std::string> texts;
      for (const Received& r : received)
        if (r.delivery.channel == channel) texts.push_back(ToText(r.delivery.packed));
      return texts;
    }
  };

  explicit LinkPair(LineConfig line = {}, std::uint64_t seed = 1, LinkOptions options = {})
      : onboard(Direction::kUp),
        offboard(Direction::kDown),
        lines(line, Rng::Stream(seed, "up"), Rng::Stream(seed, "down"), now),
        rng(Rng::Stream(seed, "nonces")) {
    onboard.options = offboard.options = options;
    Start(onboard);
    Start(offboard);
  }
  LinkPair(const LinkPair&) = delete;
  LinkPair& operator=(const LinkPair&) = delete;

  /// Starts an end, as a new process would, from what its store holds.
  void Start(End& end) {
    end.link = std::make_unique<LinkEndpoint>(
        ChannelTable(end.channels, encrypted, end.code_bytes), end.outgoing, end.key, end.options,
        end.other_store != nullptr ? *end.other_store : end.store,
        [](std::size_t, std::span<const std::byte> encoded, Time) {
          return std::optional(Packed{{encoded.begin(), encoded.end()}, encoded.size() * 8});
        },
        [this, &end] { return end.nonces_have_time ? TimedNonce(rng.engine()(), now) : rng.engine()(); }, now,
        end.next_key);
  }

  void StepOnce() {
    now += step;
    Move(onboard, line_up, lose_up);
    Move(offboard, line_down, lose_down);
    Collect(onboard, line_down.Read(now));
    Collect(offboard, line_up.Read(now));
    if (each_step) each_step();
  }
  void Run(double seconds) {
    const Time end = now + FromSeconds(seconds);
    while (now < end) StepOnce();
  }
  bool RunUntil(double seconds, const std::function<bool()>& done) {
    const Time end = now + FromSeconds(seconds);
    while (now < end && !done()) StepOnce();
    return done();
  }

  Time now = FromUtime(1'000'000'000);
  Duration step{1000};
  bool encrypted = false;
  std::function<void()> each_step;
  std::function<bool(std::span<const std::byte>)> lose_up, lose_down;  ///< true: the frame is lost
  std::function<bool(bool up)> line_cut;  ///< true: a byte that leaves now is lost
  End onboard, offboard;
  LinePair lines;
  Line &line_up = lines.a_to_b, &line_down = lines.b_to_a;
  Rng rng;
  std::vector<std::byte> wire_up, wire_down;  ///< everything that was sent

 private:
  void Move(End& end, Line& line, const std::function<bool(std::span<const std::byte>)>& lose) {
    if (!end.link) return;
    auto& wire = &end == &onboard ? wire_up : wire_down;
    auto& frame = &end == &onboard ? frame_up_ : frame_down_;
    auto& lost = &end == &onboard ? lost_up_ : lost_down_;
    for (const std::byte b : end.link->Step(now)) {
      wire.push_back(b);
      // A frame is lost or not when its first byte leaves.
      if (frame.empty()) lost = lose && lose({});
      frame.push_back(b);
      const bool cut = line_cut && line_cut(&end == &onboard);
      if (!lost && !cut) line.Write(std::span(&b, 1), now);
      if (b == kDelimiter) frame.clear();
    }
  }
  void Collect(End& end, const std::vector<std::byte>& bytes) {
    if (!end.link || bytes.empty()) return;
    for (Delivery& d : end.link->Receive(bytes, now)) end.received.push_back({now, std::move(d)});
  }
  std::vector<std::byte> frame_up_, frame_down_;
  bool lost_up_ = false, lost_down_ = false;
};

}  // namespace priamos::bus::radio
