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
      {"Clean", {}, "849e6253796140dc"},
      {"Loss", {.frame_loss = 0.3}, "675eccc17c04475a"},
      {"HeavyLoss", {.stops_hz = 2, .frame_loss = 0.7}, "8b646f6ac7262089"},
      {"BitErrors", {.line = Noisy(1e-3)}, "35cee8e9ca22af5f"},
      {"ManyBitErrors", {.line = Noisy(2e-3), .stops_hz = 3}, "976d55a630f05899"},
      {"Delay", {.line = {.latency_s = 0.12, .jitter_s = 0.03}, .frame_loss = 0.05}, "bef51ded8c9468ba"},
      {"LongDelay", {.line = {.latency_s = 0.6, .jitter_s = 0.2}}, "c1abb3ed99a650d1"},
      {"Blackouts", {.line = WithCuts(7), .frame_loss = 0.05, .seconds = 60}, "514697ff553610cf"},
      {"ShortBlackouts", {.line = WithCuts(2), .stops_hz = 2}, "9631eda4dc04d6ff"},
      {"Restarts", {.frame_loss = 0.1, .restarts_hz = 0.3, .orderly = 0.5}, "ab1b8a84747b4a77"},
      {"LostMemory",
       {.frame_loss = 0.1, .restarts_hz = 0.2, .forgets = 0.6, .orderly = 0.3},
       "0e3b5e4c92561ad1"},
      {"OldMemory", {.restarts_hz = 0.2, .rollbacks = 0.6}, "12817dfa5879c64f"},
      {"Stops", {.load = 2, .stops_hz = 8, .frame_loss = 0.1}, "db057ba7b5bc62eb"},
      {"Overload", {.load = 6, .stops_hz = 1}, "92edef9da9040dd3"},
      {"SlowAir",
       {.line = {.air_rate_bytes_s = 480}, .options = {.bytes_per_s = 480}, .load = 2},
       "02649cd3fe173aa5"},
      {"HalfDuplex", {.line = SharedAirLine(0), .options = kTurns}, "9439c302e38f73f8"},
      {"HalfDuplexDisturbed",
       {.line = SharedAirLine(1e-3),
        .options = kTurns,
        .load = 2,
        .frame_loss = 0.1,
        .restarts_hz = 0.1,
        .forgets = 0.3},
       "2a06af0d29ce7f84"},
      {"Datagrams",
       {.options = kDatagrams, .load = 2, .frame_loss = 0.05, .datagram_jitter_s = 0.08},
       "d1ad9a96e79a0d20"},
      {"DatagramsDisturbed",
       {.options = kDatagrams,
        .load = 3,
        .stops_hz = 5,
        .frame_loss = 0.2,
        .datagram_jitter_s = 0.3,
        .restarts_hz = 0.1,
        .forgets = 0.3,
        .hostile_hz = 5},
       "3216518b5e284707"},
      {"Hostile", {.hostile_hz = 30}, "36f817197cbbd263"},
      {"HostileFlood",
       {.frame_loss = 0.1, .restarts_hz = 0.1, .forgets = 0.4, .hostile_hz = 100},
       "1f753d2def1f79ad"},
      {"Insider", {.restarts_hz = 0.05, .insider_hz = 5}, "ff42cbb9df3e445b"},
      {"Encrypted",
       {.frame_loss = 0.1, .restarts_hz = 0.05, .hostile_hz = 3, .encrypted = true},
       "7d8f3361e1e695fe"},
      {"OtherTable", {.tables_differ = true, .seconds = 10}, "0a47bb14841bd996"},
      {"OtherKey", {.keys_differ = true, .seconds = 10}, "b5254885de1dbd1a"},
      {"Stalls", {.load = 2, .stalls_hz = 2}, "c18a93f402f1820e"},
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
       "15b06c7aaceec1f6"},
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
