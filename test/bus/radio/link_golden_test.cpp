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
      {"Clean", {}, "ce82351beb18a38f"},
      {"Loss", {.frame_loss = 0.3}, "8566694507150a6e"},
      {"HeavyLoss", {.stops_hz = 2, .frame_loss = 0.7}, "82287b6edc9316c3"},
      {"BitErrors", {.line = Noisy(1e-3)}, "2a2f6fd97a344478"},
      {"ManyBitErrors", {.line = Noisy(2e-3), .stops_hz = 3}, "5a343e811b07400a"},
      {"Delay", {.line = {.latency_s = 0.12, .jitter_s = 0.03}, .frame_loss = 0.05}, "e21ba725eef4b863"},
      {"LongDelay", {.line = {.latency_s = 0.6, .jitter_s = 0.2}}, "9a252186ef4cb042"},
      {"Blackouts", {.line = WithCuts(7), .frame_loss = 0.05, .seconds = 60}, "843a2e377ab3859f"},
      {"ShortBlackouts", {.line = WithCuts(2), .stops_hz = 2}, "d12c3e516bc6eb36"},
      {"Restarts", {.frame_loss = 0.1, .restarts_hz = 0.3, .orderly = 0.5}, "56a6d2a1a783784b"},
      {"LostMemory",
       {.frame_loss = 0.1, .restarts_hz = 0.2, .forgets = 0.6, .orderly = 0.3},
       "9a734706b829be65"},
      {"OldMemory", {.restarts_hz = 0.2, .rollbacks = 0.6}, "9f9ca0f3a831b622"},
      {"Stops", {.load = 2, .stops_hz = 8, .frame_loss = 0.1}, "dc2f029be3d947d6"},
      {"Overload", {.load = 6, .stops_hz = 1}, "7874c778a8c72181"},
      {"SlowAir",
       {.line = {.air_rate_bytes_s = 480}, .options = {.bytes_per_s = 480}, .load = 2},
       "b9231688027e65af"},
      {"HalfDuplex", {.line = SharedAirLine(0), .options = kTurns}, "8582bcd7a6e70d35"},
      {"HalfDuplexDisturbed",
       {.line = SharedAirLine(1e-3),
        .options = kTurns,
        .load = 2,
        .frame_loss = 0.1,
        .restarts_hz = 0.1,
        .forgets = 0.3},
       "3770123385f54ddd"},
      {"Datagrams",
       {.options = kDatagrams, .load = 2, .frame_loss = 0.05, .datagram_jitter_s = 0.08},
       "c44450521722be62"},
      {"DatagramsDisturbed",
       {.options = kDatagrams,
        .load = 3,
        .stops_hz = 5,
        .frame_loss = 0.2,
        .datagram_jitter_s = 0.3,
        .restarts_hz = 0.1,
        .forgets = 0.3,
        .hostile_hz = 5},
       "6beaa9eb8bd800fe"},
      {"Hostile", {.hostile_hz = 30}, "f0fb54c65cc5af5f"},
      {"HostileFlood",
       {.frame_loss = 0.1, .restarts_hz = 0.1, .forgets = 0.4, .hostile_hz = 100},
       "76339e1f2a8b5d7b"},
      {"Insider", {.restarts_hz = 0.05, .insider_hz = 5}, "eb8750b6025e9d4b"},
      {"Encrypted",
       {.frame_loss = 0.1, .restarts_hz = 0.05, .hostile_hz = 3, .encrypted = true},
       "23bef12c213df3bc"},
      {"OtherTable", {.tables_differ = true, .seconds = 10}, "0a47bb14841bd996"},
      {"OtherKey", {.keys_differ = true, .seconds = 10}, "b5254885de1dbd1a"},
      {"Stalls", {.load = 2, .stalls_hz = 2}, "c580132329731e40"},
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
       "30795d967039c216"},
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
