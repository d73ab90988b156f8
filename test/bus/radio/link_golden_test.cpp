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
      {"Clean", {}, "9ec55ff64f8d1cff"},
      {"Loss", {.frame_loss = 0.3}, "98883dbcded37021"},
      {"HeavyLoss", {.stops_hz = 2, .frame_loss = 0.7}, "3424cc41530fb8a9"},
      {"BitErrors", {.line = Noisy(1e-3)}, "4d655e5d5ba7fc9a"},
      {"ManyBitErrors", {.line = Noisy(2e-3), .stops_hz = 3}, "a99d85e1894b8c50"},
      {"Delay", {.line = {.latency_s = 0.12, .jitter_s = 0.03}, .frame_loss = 0.05}, "fca67930c4bcb815"},
      {"LongDelay", {.line = {.latency_s = 0.6, .jitter_s = 0.2}}, "6dd14fb601642a02"},
      {"Blackouts", {.line = WithCuts(7), .frame_loss = 0.05, .seconds = 60}, "85de43d03c1a2bff"},
      {"ShortBlackouts", {.line = WithCuts(2), .stops_hz = 2}, "3b006a11371d8087"},
      {"Restarts", {.frame_loss = 0.1, .restarts_hz = 0.3, .orderly = 0.5}, "fedc44c13e692edf"},
      {"LostMemory",
       {.frame_loss = 0.1, .restarts_hz = 0.2, .forgets = 0.6, .orderly = 0.3},
       "e9933ed69b56416a"},
      {"OldMemory", {.restarts_hz = 0.2, .rollbacks = 0.6}, "54f9ceb11b8e5c74"},
      {"Stops", {.load = 2, .stops_hz = 8, .frame_loss = 0.1}, "904894a528d27c22"},
      {"Overload", {.load = 6, .stops_hz = 1}, "e3f9bfdfd021ab59"},
      {"SlowAir",
       {.line = {.air_rate_bytes_s = 480}, .options = {.bytes_per_s = 480}, .load = 2},
       "c1548e2d0fe6b63e"},
      {"HalfDuplex", {.line = SharedAirLine(0), .options = kTurns}, "38cc16d6a07c3174"},
      {"HalfDuplexDisturbed",
       {.line = SharedAirLine(1e-3),
        .options = kTurns,
        .load = 2,
        .frame_loss = 0.1,
        .restarts_hz = 0.1,
        .forgets = 0.3},
       "27505d6da60ea98e"},
      {"Datagrams",
       {.options = kDatagrams, .load = 2, .frame_loss = 0.05, .datagram_jitter_s = 0.08},
       "64404a7e5b3b9171"},
      {"DatagramsDisturbed",
       {.options = kDatagrams,
        .load = 3,
        .stops_hz = 5,
        .frame_loss = 0.2,
        .datagram_jitter_s = 0.3,
        .restarts_hz = 0.1,
        .forgets = 0.3,
        .hostile_hz = 5},
       "792a7adc4cab0a0d"},
      {"Hostile", {.hostile_hz = 30}, "5fb8deb0c284ac6f"},
      {"HostileFlood",
       {.frame_loss = 0.1, .restarts_hz = 0.1, .forgets = 0.4, .hostile_hz = 100},
       "eb830a1b5fed4c39"},
      {"Insider", {.restarts_hz = 0.05, .insider_hz = 5}, "42bf95597f50e26d"},
      {"Encrypted",
       {.frame_loss = 0.1, .restarts_hz = 0.05, .hostile_hz = 3, .encrypted = true},
       "61d7cb38a158a003"},
      {"OtherTable", {.tables_differ = true, .seconds = 10}, "902f606af721796f"},
      {"OtherKey", {.keys_differ = true, .seconds = 10}, "118f3d0694e45526"},
      {"Stalls", {.load = 2, .stalls_hz = 2}, "6b647aca19509d39"},
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
       "98c1126b1981cf37"},
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
