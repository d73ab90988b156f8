#include <gtest/gtest.h>

#include <map>

#include "tiny_world.hpp"

// The small end against a real one, on an emulated line.
// bus/radio/tiny/README.md.

namespace priamos::bus::radio {
namespace {

std::vector<std::uint8_t> Numbered(std::size_t bytes, std::uint64_t n) {
  std::vector<std::uint8_t> message(bytes);
  for (std::size_t i = 0; i < std::min<std::size_t>(bytes, 4); ++i)
    message[i] = static_cast<std::uint8_t>(n >> 8 * i);
  return message;
}
std::vector<std::byte> AsBytes(const std::vector<std::uint8_t>& bytes) {
  std::vector<std::byte> out;
  for (const std::uint8_t b : bytes) out.push_back(std::byte{b});
  return out;
}
std::uint64_t NumberOf(const std::vector<std::byte>& bytes) {
  std::uint64_t n = 0;
  for (std::size_t i = std::min<std::size_t>(4, bytes.size()); i-- > 0;)
    n = n << 8 | std::to_integer<std::uint64_t>(bytes[i]);
  return n;
}

/// Stops once per second with their number, after each of which it is known how often and when it came.
struct Stops {
  TinyWorld& world;
  std::uint64_t sent = 0;
  std::map<std::uint64_t, Time> at{};
  void Step(Duration every) {
    if (ToUtime(world.now) % every.count() != 0) return;
    if (world.real->Offer(kTinyStop, AsBytes(Numbered(2, ++sent)), world.now) == OfferResult::kAccepted)
      at[sent] = world.now;
    else
      --sent;
  }
  void ExpectEachOnceInOrder() const {
    const auto came = world.DownOf(kTinyStop);
    ASSERT_EQ(came.size(), sent);
    for (std::size_t i = 0; i < came.size(); ++i) ASSERT_EQ(NumberOf(came[i].packed), i + 1);
  }
};

TEST(TinyEnd, BothEndsAgreeAndStatesArrive) {
  TinyWorld dut;
  ASSERT_EQ(dut.status, PR_OK);
  dut.Run(1);
  EXPECT_TRUE(pr_up(&dut.tiny, dut.Us()));
  EXPECT_TRUE(dut.real->Status(dut.now).up);
  std::uint64_t n = 0;
  dut.Run(10, [&] {
    if (ToUtime(dut.now) % 100'000 == 0) pr_offer(&dut.tiny, kTinyPose, Numbered(11, ++n).data(), 83);
  });
  EXPECT_GE(dut.up.size(), 95U);
  EXPECT_EQ(NumberOf(dut.up.back().packed), n);
}

TEST(TinyEnd, AStateOfVaryingSizeArrivesWhole) {
  TinyWorld dut;
  dut.Run(1);
  const auto name = Numbered(20, 77);
  ASSERT_EQ(pr_offer(&dut.tiny, kTinyName, name.data(), 8 * name.size()), PR_OK);
  dut.Run(1);
  ASSERT_EQ(dut.up.size(), 1U);
  EXPECT_EQ(dut.up[0].packed, AsBytes(name));
}

TEST(TinyEnd, EncryptedAndWithLongerCodesToo) {
  for (const bool encrypted : {false, true}) {
    for (const std::size_t code : {4U, 6U, 8U}) {
      TinyWorld dut({}, 2, encrypted, code);
      Stops stops{dut};
      dut.Run(10, [&] { stops.Step(Duration(1'000'000)); });
      dut.Run(2);
      stops.ExpectEachOnceInOrder();
      EXPECT_GE(stops.sent, 9U);
    }
  }
}

TEST(TinyEnd, CommandsAreObeyedFreshAndNeverOlderThanTheirTimeToLive) {
  for (const double delay_s : {0.0, 0.02, 0.045, 0.3, 1.0}) {
    LineConfig line;
    line.latency_s = 0.002;
    line.delays = {
        {.way = "b_to_a", .from_s = 5, .to_s = 1e6, .first_s = 2 * delay_s, .last_s = 2 * delay_s}};
    TinyWorld dut(line, 3);
    std::map<std::uint64_t, Time> offered;
    std::uint64_t n = 0;
    dut.Run(20, [&] {
      if (ToUtime(dut.now) % 50'000 != 0) return;
      dut.real->Offer(kTinyDrive, AsBytes(Numbered(5, ++n)), dut.now);
      offered[n] = dut.now;
    });
    std::size_t late = 0, younger = 0, after_step = 0;
    for (const auto& c : dut.DownOf(kTinyDrive)) {
      const Time at = offered[NumberOf(c.packed)];
      late += c.at - at > Duration(250'000) ? 1 : 0;
      younger += c.offered > at ? 1 : 0;
      after_step += c.at > FromUtime(1'006'000'000) ? 1 : 0;
    }
    EXPECT_EQ(late + younger, 0U) << delay_s;
    if (2 * delay_s <= 0.09) {
      EXPECT_GE(after_step, 200U) << delay_s;
    } else {
      EXPECT_EQ(after_step, 0U) << delay_s;
    }
  }
}

TEST(TinyEnd, StopsArriveOnceOverALineWithErrorsAndCuts) {
  LineConfig line;
  line.bit_error_rate = 1e-3;
  for (int i = 0; i < 10; ++i) line.cuts.push_back({.from_s = 5.0 + 10 * i, .to_s = 7.5 + 10 * i});
  TinyWorld dut(line, 4);
  Stops stops{dut};
  dut.Run(110, [&] {
    stops.Step(Duration(500'000));
    if (ToUtime(dut.now) % 100'000 == 0) pr_offer(&dut.tiny, kTinyPose, Numbered(11, 1).data(), 83);
  });
  dut.Run(20);
  stops.ExpectEachOnceInOrder();
  EXPECT_GE(stops.sent, 200U);
}

TEST(TinyEnd, ARestartLosesAndRepeatsNoEvent) {
  TinyWorld dut({}, 5);
  Stops stops{dut};
  for (int i = 0; i < 12; ++i) {
    dut.Run(1.7, [&] { stops.Step(Duration(250'000)); });
    if (i % 3 != 1) dut.StartTiny();
    if (i % 3 != 0) dut.StartReal();
  }
  dut.Run(15);
  stops.ExpectEachOnceInOrder();
}

TEST(TinyEnd, WithoutItsMemoryItAgreesAnewAndTakesNoEventForAnOldOne) {
  TinyWorld dut({}, 6);
  dut.Run(2);
  dut.real->Offer(kTinyStop, AsBytes(Numbered(2, 1)), dut.now);
  dut.Run(1);
  dut.memory.clear();
  dut.StartTiny();
  dut.Run(5);
  dut.real->Offer(kTinyStop, AsBytes(Numbered(2, 2)), dut.now);
  dut.Run(2);
  const auto came = dut.DownOf(kTinyStop);
  ASSERT_EQ(came.size(), 2U);
  EXPECT_EQ(NumberOf(came[1].packed), 2U);
}

TEST(TinyEnd, WithoutADiskNothingIsAcknowledged) {
  TinyWorld dut({}, 7);
  dut.Run(2);
  dut.memory_fails = true;
  dut.real->Offer(kTinyStop, AsBytes(Numbered(2, 1)), dut.now);
  dut.Run(3);
  EXPECT_EQ(dut.real->waiting(kTinyStop), 1U);
  dut.memory_fails = false;
  dut.Run(3);
  EXPECT_EQ(dut.real->waiting(kTinyStop), 0U);
  EXPECT_EQ(dut.DownOf(kTinyStop).size(), 1U);
}

TEST(TinyEnd, TheMemoryIsWrittenRarely) {
  TinyWorld dut({}, 8);
  dut.Run(3);
  const std::size_t before = dut.saves;
  dut.Run(60, [&] {
    if (ToUtime(dut.now) % 100'000 == 0) pr_offer(&dut.tiny, kTinyPose, Numbered(11, 1).data(), 83);
  });
  EXPECT_LE(dut.saves - before, 8U);
}

TEST(TinyEnd, NothingForeignIsAccepted) {
  TinyWorld dut({}, 9);
  dut.Run(2);
  const std::size_t before = dut.down.size();
  const auto heard = dut.tiny.in.window.highest;
  Rng rng = Rng::Stream(9, "garbage");
  for (int i = 0; i < 1'000'000; ++i) {
    // Short frames and long ones, and such as look like blocks.
    const auto byte =
        static_cast<std::uint8_t>(rng.engine()() % 24 == 0 ? 0 : rng.engine()() | (i / 4096 % 2 ? 0x80 : 0));
    pr_receive(&dut.tiny, &byte, 1, dut.Us() + static_cast<std::uint64_t>(i) * 1042);
  }
  EXPECT_EQ(dut.down.size(), before);
  EXPECT_EQ(dut.tiny.in.window.highest, heard);
}

TEST(TinyEnd, RefusesWhatItCannotServe) {
  TinyWorld dut;
  EXPECT_EQ(pr_offer(&dut.tiny, kTinyPose, Numbered(11, 1).data(), 82), PR_BAD_MESSAGE);
  EXPECT_EQ(pr_offer(&dut.tiny, kTinyDrive, Numbered(5, 1).data(), 40), PR_BAD_MESSAGE);
  EXPECT_EQ(pr_offer(&dut.tiny, 99, Numbered(5, 1).data(), 40), PR_BAD_MESSAGE);
  EXPECT_EQ(pr_table_hash(dut.tiny.config), RealTable().hash());
  pr_channel path{"PATH", 1, PR_DOWN, PR_EVENT, 0, 893, 0, false, nullptr};
  pr_config config = *dut.tiny.config;
  config.channels = &path;
  config.n_channels = 1;
  pr_end end;
  EXPECT_EQ(pr_init(&end, &config, 0), PR_BAD_TABLE);
  config.code_bytes = 5;
  EXPECT_EQ(pr_init(&end, &config, 0), PR_BAD_CONFIG);
}

}  // namespace
}  // namespace priamos::bus::radio
