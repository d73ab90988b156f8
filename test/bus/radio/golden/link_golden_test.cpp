#include <fmt/format.h>
#include <gtest/gtest.h>

#include "link_world.hpp"

// A change of the inside of the link changes no byte on the line, no write to its memory and no message that
// it delivers. Who changes what the link does on purpose says so, and takes the digests that this test
// prints.

namespace priamos::bus::radio {
namespace {

struct Scenario {
  const char* name;
  World world;
  const char* digest;  ///< over the runs of three seeds
};
void PrintTo(const Scenario& scenario, std::ostream* out) {
  *out << scenario.name;
}

LineConfig Noisy(double bit_error_rate) {
  return {.latency_s = 0.01,
          .jitter_s = 0.005,
          .bit_error_rate = bit_error_rate,
          .burst_rate_hz = 0.3,
          .duplicate_probability = 1e-4};
}

LineConfig WithCuts(double period_s) {
  LineConfig line{.latency_s = 0.02};
  for (double at = period_s; at < 60; at += period_s) line.cuts.push_back({at, at + 0.6 * period_s});
  return line;
}

LineConfig SharedAirLine(double bit_error_rate) {
  return {.latency_s = 0.01, .bit_error_rate = bit_error_rate, .half_duplex = true, .turnaround_s = 0.02};
}

const LinkOptions kTurns{.half_duplex = {.turn = Duration(400'000), .turnaround = Duration(20'000)}};
const LinkOptions kDatagrams{.bytes_per_s = 3000, .datagrams = true};

const std::vector<Scenario>& Scenarios() {
  static const std::vector<Scenario> scenarios{
      {"Clean", {}, "0addde7e35d46172"},
      {"Loss", {.frame_loss = 0.3}, "71a5a63b52fc5901"},
      {"HeavyLoss", {.stops_hz = 2, .frame_loss = 0.7}, "892a9f0f1570fcb4"},
      {"BitErrors", {.line = Noisy(1e-3)}, "714bd4d0d91cc116"},
      {"ManyBitErrors", {.line = Noisy(2e-3), .stops_hz = 3}, "440dc4e4d1f62643"},
      {"Delay", {.line = {.latency_s = 0.12, .jitter_s = 0.03}, .frame_loss = 0.05}, "6424457a3b897ee9"},
      {"LongDelay", {.line = {.latency_s = 0.6, .jitter_s = 0.2}}, "4ca8cb8888da3c27"},
      {"Blackouts", {.line = WithCuts(7), .frame_loss = 0.05, .seconds = 60}, "5da1b1b6ba7cdf7d"},
      {"ShortBlackouts", {.line = WithCuts(2), .stops_hz = 2}, "ba587c6532464ef7"},
      {"Restarts", {.frame_loss = 0.1, .restarts_hz = 0.3, .orderly = 0.5}, "cd5a0389bf1d2e4d"},
      {"LostMemory",
       {.frame_loss = 0.1, .restarts_hz = 0.2, .forgets = 0.6, .orderly = 0.3},
       "db9526ae12255086"},
      {"OldMemory", {.restarts_hz = 0.2, .rollbacks = 0.6}, "ca3c73a4625a03f6"},
      {"Stops", {.load = 2, .stops_hz = 8, .frame_loss = 0.1}, "bd449e47b40be655"},
      {"Overload", {.load = 6, .stops_hz = 1}, "f584959b9f204193"},
      {"SlowAir",
       {.line = {.air_rate_bytes_s = 480}, .options = {.bytes_per_s = 480}, .load = 2},
       "80632c5557edb887"},
      {"HalfDuplex", {.line = SharedAirLine(0), .options = kTurns}, "9ad72b529408e5e4"},
      {"HalfDuplexDisturbed",
       {.line = SharedAirLine(1e-3),
        .options = kTurns,
        .load = 2,
        .frame_loss = 0.1,
        .restarts_hz = 0.1,
        .forgets = 0.3},
       "526d1fad1976ff53"},
      {"Datagrams",
       {.options = kDatagrams, .load = 2, .frame_loss = 0.05, .datagram_jitter_s = 0.08},
       "2a5107215a70e12b"},
      {"DatagramsDisturbed",
       {.options = kDatagrams,
        .load = 3,
        .stops_hz = 5,
        .frame_loss = 0.2,
        .datagram_jitter_s = 0.3,
        .restarts_hz = 0.1,
        .forgets = 0.3,
        .hostile_hz = 5},
       "f15d268eb100b289"},
      {"Hostile", {.hostile_hz = 30}, "dd9876078947811f"},
      {"HostileFlood",
       {.frame_loss = 0.1, .restarts_hz = 0.1, .forgets = 0.4, .hostile_hz = 100},
       "d19e4ce15d514ff6"},
      {"Insider", {.restarts_hz = 0.05, .insider_hz = 5}, "b3be81ebdb710b89"},
      {"Encrypted",
       {.frame_loss = 0.1, .restarts_hz = 0.05, .hostile_hz = 3, .encrypted = true},
       "ffa10eb905461d58"},
      {"OtherTable", {.tables_differ = true, .seconds = 10}, "240910fc559a78ed"},
      {"OtherKey", {.keys_differ = true, .seconds = 10}, "cad29e0158e61bc9"},
      {"Stalls", {.load = 2, .stalls_hz = 2}, "86ccaa10fa110410"},
      {"Everything",
       {.line = Noisy(3e-4),
        .load = 2,
        .stops_hz = 3,
        .frame_loss = 0.1,
        .restarts_hz = 0.1,
        .forgets = 0.2,
        .rollbacks = 0.1,
        .orderly = 0.3,
        .hostile_hz = 10,
        .stalls_hz = 0.5,
        .encrypted = true,
        .seconds = 60},
       "fe46de917c2eeb28"},
  };
  return scenarios;
}

class LinkGolden : public testing::TestWithParam<Scenario> {};

TEST_P(LinkGolden, DoesWhatItDid) {
  const Scenario& s = GetParam();
  Trace all;
  std::size_t classes = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    WorldRun dut(s.world, seed);
    dut.Run();
    all.Number(dut.digest());
    classes = std::max(classes, dut.delivered().size());
  }
  // A world in which nothing happens would prove nothing. On a line that is slower there and back than every
  // time-to-live no command can be proven fresh.
  const std::size_t alive = s.world.line.latency_s > 0.5 ? 2 : 3;
  EXPECT_EQ(classes, s.world.tables_differ || s.world.keys_differ ? 0U : alive);
  EXPECT_EQ(fmt::format("{:016x}", all.digest()), s.digest);
}

INSTANTIATE_TEST_SUITE_P(Worlds, LinkGolden, testing::ValuesIn(Scenarios()),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace priamos::bus::radio
