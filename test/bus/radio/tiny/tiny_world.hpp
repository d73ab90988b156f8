#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bus/radio/line/line.hpp"
#include "bus/radio/link.hpp"
#include "bus/radio/link_state.hpp"
#include "hostile_line.hpp"

extern "C" {
#include "priamos_radio.h"
}

namespace priamos::bus::radio {

/// Channels of the tests, as the small end has them.
enum TinyChannel : std::size_t { kTinyPose, kTinyName, kTinyDrive, kTinyStop, kTinyNote };

inline const std::vector<pr_channel>& TinyChannels() {
  static const std::vector<pr_channel> channels{
      {"POSE", 0x1122334455667788, PR_UP, PR_STATE, 83, 83, 0, false, nullptr},
      {"NAME", 0x2122334455667788, PR_UP, PR_STATE, 0, 160, 0, false, nullptr},
      {"DRIVE", 0x99aabbccddeeff00, PR_DOWN, PR_COMMAND, 40, 40, 250000, false, nullptr},
      {"STOP", 0x0123456789abcdef, PR_DOWN, PR_EVENT, 16, 16, 0, true, nullptr},
      {"NOTE", 0x0123456789abcd00, PR_DOWN, PR_EVENT, 0, 200, 0, false, nullptr}};
  return channels;
}

/// The same for a real end.
inline ChannelTable RealTable(bool encrypted = false, std::size_t code_bytes = kShortCodeBytes) {
  std::vector<LinkChannel> channels;
  for (const pr_channel& c : TinyChannels()) {
    LinkChannel channel;
    channel.name = c.name;
    channel.fingerprint = c.meaning;
    channel.direction = c.direction == PR_UP ? Direction::kUp : Direction::kDown;
    channel.channel_class = c.channel_class == PR_EVENT     ? ChannelClass::kEvent
                            : c.channel_class == PR_COMMAND ? ChannelClass::kCommand
                                                            : ChannelClass::kState;
    channel.fixed_bits = c.fixed_bits;
    channel.max_bits = c.max_bits;
    channel.rate_hz = c.channel_class == PR_EVENT ? 0 : 20;
    channel.ttl = Duration(c.ttl_us);
    channel.urgent = c.urgent;
    channel.priority = c.urgent ? 0 : 2;
    channels.push_back(std::move(channel));
  }
  return {std::move(channels), encrypted, code_bytes};
}

/// The small end onboard, and a real one offboard, on an emulated line in simulated time.
class TinyWorld {
 public:
  struct Came {
    Time at;
    std::size_t channel;
    std::vector<std::byte> packed;
    Time offered;
  };

  explicit TinyWorld(LineConfig line = {}, std::uint64_t seed = 1, bool encrypted = false,
                     std::size_t code_bytes = kShortCodeBytes)
      : encrypted_(encrypted),
        code_bytes_(code_bytes),
        lines(line, Rng::Stream(seed, "up"), Rng::Stream(seed, "down"), now),
        rng(Rng::Stream(seed, "nonces")) {
    config_ = {
        .channels = TinyChannels().data(),
        .n_channels = TinyChannels().size(),
        .key = key_.data(),
        .encrypted = encrypted,
        .code_bytes = static_cast<std::uint8_t>(code_bytes),
        .bytes_per_s = 960,
        .keep_alive_us = 250'000,
        .silence_us = 1'500'000,
        .user = this,
        .nonce = [](void* self) { return static_cast<TinyWorld*>(self)->rng.engine()(); },
        .load = [](void* self, std::uint8_t* bytes, std::size_t room) { return As(self).Load(bytes, room); },
        .save = [](void* self, const std::uint8_t* bytes, std::size_t n) { return As(self).Save(bytes, n); },
        .deliver = [](void* self, const pr_delivery* d) { As(self).Note(*d); }};
    StartTiny();
    StartReal();
  }
  TinyWorld(const TinyWorld&) = delete;
  TinyWorld& operator=(const TinyWorld&) = delete;

  void StartTiny() { status = pr_init(&tiny, &config_, Us()); }
  void StartReal() {
    real = std::make_unique<LinkEndpoint>(
        RealTable(encrypted_, code_bytes_), Direction::kDown, key_, LinkOptions{}, store,
        [](std::size_t channel, std::span<const std::byte> encoded, Time) {
          const std::size_t fixed = TinyChannels()[channel].fixed_bits;
          return std::optional(
              Packed{{encoded.begin(), encoded.end()}, fixed > 0 ? fixed : 8 * encoded.size()});
        },
        [this] { return rng.engine()(); }, now);
  }

  void StepOnce() {
    now += Duration(1000);
    std::array<std::uint8_t, 64> out{};
    const std::size_t n = pr_step(&tiny, Us(), out.data(), out.size());
    lines.a_to_b.Write(std::as_bytes(std::span(out).first(n)), now);
    lines.b_to_a.Write(real->Step(now), now);
    const auto between = [this](HostileLine* line, std::vector<std::byte> bytes) {
      return line == nullptr ? bytes : line->Pass(bytes, now);
    };
    for (const std::byte b : between(hostile_down.get(), lines.b_to_a.Read(now))) {
      const auto byte = std::to_integer<std::uint8_t>(b);
      pr_receive(&tiny, &byte, 1, Us());
    }
    for (Delivery& d : real->Receive(between(hostile_up.get(), lines.a_to_b.Read(now)), now))
      up.push_back({now, d.channel, std::move(d.packed), d.packed_at});
  }
  void Run(double seconds, const std::function<void()>& each = {}) {
    for (const Time end = now + FromSeconds(seconds); now < end;) {
      if (each) each();
      StepOnce();
    }
  }
  std::vector<Came> DownOf(std::size_t channel) const {
    std::vector<Came> of;
    for (const Came& c : down)
      if (c.channel == channel) of.push_back(c);
    return of;
  }
  std::uint64_t Us() const { return static_cast<std::uint64_t>(ToUtime(now)); }

  Time now = FromUtime(1'000'000'000);
  pr_end tiny{};
  pr_status status = PR_OK;
  std::unique_ptr<LinkEndpoint> real;
  MemoryStore store;
  std::vector<std::uint8_t> memory;  ///< of the small end
  bool memory_fails = false;
  std::size_t saves = 0;
  std::vector<Came> up, down;
  std::unique_ptr<HostileLine> hostile_up, hostile_down;  ///< who sits on the line; null: nobody

 private:
  static TinyWorld& As(void* self) { return *static_cast<TinyWorld*>(self); }
  std::size_t Load(std::uint8_t* bytes, std::size_t room) const {
    std::copy_n(memory.begin(), std::min(room, memory.size()), bytes);
    return memory.size();
  }
  bool Save(const std::uint8_t* bytes, std::size_t n) {
    if (memory_fails) return false;
    memory.assign(bytes, bytes + n);
    ++saves;
    return true;
  }
  void Note(const pr_delivery& d) {
    const auto* from = reinterpret_cast<const std::byte*>(d.packed);
    down.push_back(
        {now, d.channel, {from, from + (d.bits + 7) / 8}, FromUtime(static_cast<std::int64_t>(d.time_us))});
  }

  LinkKey key_{1, 2, 3};
  pr_config config_{};
  bool encrypted_;
  std::size_t code_bytes_;

 public:
  LinePair lines;
  Rng rng;
};

}  // namespace priamos::bus::radio
