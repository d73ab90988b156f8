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
      {"Clean", {}, "46d7b80818e5dcdc"},
      {"Loss", {.frame_loss = 0.3}, "3cb31f8d6a1b7566"},
      {"HeavyLoss", {.stops_hz = 2, .frame_loss = 0.7}, "44671941987341ce"},
      {"BitErrors", {.line = Noisy(1e-3)}, "f067508dd37509a5"},
      {"ManyBitErrors", {.line = Noisy(2e-3), .stops_hz = 3}, "e03e1cc7d839ba54"},
      {"Delay", {.line = {.latency_s = 0.12, .jitter_s = 0.03}, .frame_loss = 0.05}, "e1b4ea2e179aeac3"},
      {"LongDelay", {.line = {.latency_s = 0.6, .jitter_s = 0.2}}, "bd6c41f086330b25"},
      {"Blackouts", {.line = WithCuts(7), .frame_loss = 0.05, .seconds = 60}, "bf3c484ad3907578"},
      {"ShortBlackouts", {.line = WithCuts(2), .stops_hz = 2}, "fa4a9965b20ead45"},
      {"Restarts", {.frame_loss = 0.1, .restarts_hz = 0.3, .orderly = 0.5}, "b91a1cf4225e9c3e"},
      {"LostMemory",
       {.frame_loss = 0.1, .restarts_hz = 0.2, .forgets = 0.6, .orderly = 0.3},
       "200fc5e2c9be57df"},
      {"OldMemory", {.restarts_hz = 0.2, .rollbacks = 0.6}, "51bf31e8eb78a199"},
      {"Stops", {.load = 2, .stops_hz = 8, .frame_loss = 0.1}, "b8f6b7cd830e4e31"},
      {"Overload", {.load = 6, .stops_hz = 1}, "700a0845029b6840"},
      {"SlowAir",
       {.line = {.air_rate_bytes_s = 480}, .options = {.bytes_per_s = 480}, .load = 2},
       "c1e5f27c612d266d"},
      {"HalfDuplex", {.line = SharedAirLine(0), .options = kTurns}, "52f9b78bab05e483"},
      {"HalfDuplexDisturbed",
       {.line = SharedAirLine(1e-3),
        .options = kTurns,
        .load = 2,
        .frame_loss = 0.1,
        .restarts_hz = 0.1,
        .forgets = 0.3},
       "93b4c71608783d92"},
      {"Datagrams",
       {.options = kDatagrams, .load = 2, .frame_loss = 0.05, .datagram_jitter_s = 0.08},
       "a4a638d0d5c3b064"},
      {"DatagramsDisturbed",
       {.options = kDatagrams,
        .load = 3,
        .stops_hz = 5,
        .frame_loss = 0.2,
        .datagram_jitter_s = 0.3,
        .restarts_hz = 0.1,
        .forgets = 0.3,
        .hostile_hz = 5},
       "45bd6fc182e59f32"},
      {"Hostile", {.hostile_hz = 30}, "1be5d8abb3ae6dfc"},
      {"HostileFlood",
       {.frame_loss = 0.1, .restarts_hz = 0.1, .forgets = 0.4, .hostile_hz = 100},
       "4b26e191f65facca"},
      {"Insider", {.restarts_hz = 0.05, .insider_hz = 5}, "92da5b2c2f812af5"},
      {"Encrypted",
       {.frame_loss = 0.1, .restarts_hz = 0.05, .hostile_hz = 3, .encrypted = true},
       "b4f0c94d3ab37641"},
      {"OtherTable", {.tables_differ = true, .seconds = 10}, "3534c67380344ad2"},
      {"OtherKey", {.keys_differ = true, .seconds = 10}, "355a79be8ccc8842"},
      {"Stalls", {.load = 2, .stalls_hz = 2}, "7314f1827ca6cab9"},
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
       "fba0f503ebf0120d"},
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
