#include <gtest/gtest.h>

#include <array>

#include "tiny_world.hpp"

// The small end on a line on which somebody loses, doubles, holds, damages and replays frames, and sends his
// own: events come once and in order, and as many as at an ordinary end.

namespace priamos::bus::radio {
namespace {

std::vector<std::byte> Numbered(std::size_t bytes, std::uint64_t n) {
  std::vector<std::byte> message(bytes);
  for (std::size_t i = 0; i < std::min<std::size_t>(bytes, 4); ++i) message[i] = std::byte(n >> 8 * i & 0xff);
  return message;
}

std::vector<std::uint64_t> Numbers(const std::vector<TinyWorld::Came>& came) {
  std::vector<std::uint64_t> numbers;
  for (const auto& c : came)
    numbers.push_back(std::to_integer<std::uint64_t>(c.packed[0]) |
                      std::to_integer<std::uint64_t>(c.packed[1]) << 8);
  return numbers;
}

/// A stop every other second and three notes of 20 bytes a second; `restarts`: the ends are started again in
/// turn, one every 4 s.
class HostileWorld {
 public:
  HostileWorld(const Hostility& does, double bit_error_rate, std::uint64_t seed)
      : world_({.bit_error_rate = bit_error_rate}, seed) {
    world_.hostile_up = std::make_unique<HostileLine>(does, Rng::Stream(seed, "hostile up"));
    world_.hostile_down = std::make_unique<HostileLine>(does, Rng::Stream(seed, "hostile down"));
  }
  void Run(double seconds, bool restarts) {
    world_.Run(seconds, [&] {
      const auto ms = (ToUtime(world_.now) - 1'000'000'000) / 1000;
      if (ms % 330 == 0) Offer(kTinyNote, 20, notes);
      if (ms % 2000 == 100) Offer(kTinyStop, 2, stops);
      if (ms % 100 == 0) pr_offer(&world_.tiny, kTinyPose, kPose, 83);
      if (restarts && ms % 8000 == 4001) Reset();
      if (restarts && ms % 8000 == 8000 - 1) world_.StartReal();
    });
  }
  /// Nobody is on the line any more, and nothing is offered.
  void Rest(double seconds) {
    world_.hostile_up->Rest();
    world_.hostile_down->Rest();
    world_.Run(seconds);
  }
  std::size_t Came(TinyChannel channel) const { return world_.DownOf(channel).size(); }
  void ExpectAllOnceInOrder(TinyChannel channel, std::uint64_t offered) const {
    const auto numbers = Numbers(world_.DownOf(channel));
    ASSERT_EQ(numbers.size(), offered) << channel;
    for (std::size_t i = 0; i < numbers.size(); ++i) ASSERT_EQ(numbers[i], i + 1) << channel;
  }
  std::uint64_t notes = 0, stops = 0;

 private:
  static constexpr std::uint8_t kPose[11] = {1};
  /// Not in the millisecond between handing an event on and saving that, which would double it.
  void Reset() {
    std::array<std::uint8_t, 64> lost{};
    pr_step(&world_.tiny, world_.Us(), lost.data(), lost.size());
    world_.StartTiny();
  }
  void Offer(TinyChannel channel, std::size_t bytes, std::uint64_t& n) {
    if (world_.real->Offer(channel, Numbered(bytes, n + 1), world_.now) == OfferResult::kAccepted) ++n;
  }
  TinyWorld world_;
};

/// Half of the frames are cut off by replays and garbage, and some are lost, doubled and held besides.
constexpr Hostility kHostile{.lost = 0.1, .doubled = 0.1, .held = 0.1, .replays_hz = 6, .garbage_hz = 4};

TEST(TinyHostile, EventsComeOnceInOrderAndKeepUp) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    HostileWorld dut(kHostile, 1e-4, seed);
    dut.Run(44, false);
    const std::size_t came = dut.Came(kTinyNote);
    std::printf("%zu of %llu notes, %zu of %llu stops\n", came, static_cast<unsigned long long>(dut.notes),
                dut.Came(kTinyStop), static_cast<unsigned long long>(dut.stops));
    EXPECT_GE(came + 12, dut.notes) << "of three a second those of the last seconds may be under way";
    dut.Rest(30);
    dut.ExpectAllOnceInOrder(kTinyNote, dut.notes);
    dut.ExpectAllOnceInOrder(kTinyStop, dut.stops);
    EXPECT_GE(dut.notes, 130U);
  }
}

TEST(TinyHostile, RestartsLoseAndRepeatNoEvent) {
  for (const std::uint64_t seed : {4U, 5U, 6U}) {
    HostileWorld dut(kHostile, 1e-4, seed);
    dut.Run(60, true);
    dut.Rest(40);
    dut.ExpectAllOnceInOrder(kTinyNote, dut.notes);
    dut.ExpectAllOnceInOrder(kTinyStop, dut.stops);
  }
}

}  // namespace
}  // namespace priamos::bus::radio
