#include "test/bus/radio/explorer/exploration.hpp"

#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

// Every world with one accident, on a serial line and on a network, and some with several. bench_exploration
// takes all worlds with two.

namespace priamos::bus::radio {
namespace {

using testing::IsEmpty;

TEST(ExploredRun, WithoutAccidentsKeepsEveryPromise) {
  for (const bool datagrams : {false, true}) {
    ExploredRun dut({.datagrams = datagrams}, {});
    EXPECT_THAT(dut.Run(), IsEmpty());
    EXPECT_GE(dut.places().size(), 150U);
  }
}

TEST(ExploredRun, IsTheSameAgain) {
  const std::vector<Mishap> mishaps{{.place = 30, .accident = Accident::kLost}};
  ExploredRun first({}, mishaps), second({}, mishaps);
  first.Run();
  second.Run();
  EXPECT_EQ(first.places(), second.places());
}

/// The accidents in parts, so that each is a short test.
constexpr std::size_t kParts = 4;
class ExplorationOfOneAccident : public testing::TestWithParam<std::tuple<bool, std::size_t>> {};

TEST_P(ExplorationOfOneAccident, KeepsEveryPromise) {
  const auto [datagrams, part] = GetParam();
  const Explored explored = Explore({.datagrams = datagrams}, 1, part, kParts);
  EXPECT_GE(explored.runs, 100U);
  EXPECT_THAT(explored.findings, IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Parts, ExplorationOfOneAccident,
                         testing::Combine(testing::Bool(), testing::Range(std::size_t{0}, kParts)));

class ExplorationOfAPacketRadio : public testing::TestWithParam<std::size_t> {};

TEST_P(ExplorationOfAPacketRadio, KeepsEveryPromise) {
  const ExploredWorld world{.datagrams = true, .packet_overhead = Duration(5000)};
  const Explored explored = Explore(world, 1, GetParam(), kParts);
  EXPECT_GE(explored.runs, 100U);
  EXPECT_THAT(explored.findings, IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Parts, ExplorationOfAPacketRadio, testing::Range(std::size_t{0}, kParts));

class ExplorationOfARekey : public testing::TestWithParam<std::tuple<bool, std::size_t>> {};

TEST_P(ExplorationOfARekey, KeepsEveryPromiseAndChangesTheKeyWhateverHappensOnce) {
  const auto [datagrams, part] = GetParam();
  const Explored explored = Explore({.datagrams = datagrams, .rekey = true}, 1, part, kParts);
  EXPECT_GE(explored.runs, 100U);
  EXPECT_THAT(explored.findings, IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Parts, ExplorationOfARekey,
                         testing::Combine(testing::Bool(), testing::Range(std::size_t{0}, kParts)));

/// Urgent events that nobody acknowledges left no turn to the hello under the next key.
TEST(ExploredRun, AnEndThatIsKilledWhileTheOtherChangesTheKeyFollows) {
  const std::vector<Mishap> mishaps{{.place = 5, .accident = Accident::kEmptied},
                                    {.place = 144, .accident = Accident::kKilled}};
  EXPECT_THAT(ExploredRun({.datagrams = true, .rekey = true}, mishaps).Run(), IsEmpty());
}

/// Over datagrams, whose heads were not counted, repetitions of urgent events took the whole line, and hellos
/// every turn that was left: the other end never heard which counters to skip.
TEST(ExploredRun, TheFloorOfAKilledEndIsNotKeptBackByUrgentEvents) {
  const std::vector<Mishap> mishaps{{.place = 5, .accident = Accident::kKilled},
                                    {.place = 106, .accident = Accident::kLost}};
  EXPECT_THAT(ExploredRun({.datagrams = true}, mishaps).Run(), IsEmpty());
}

class ExplorationOfSeveralAccidents : public testing::TestWithParam<std::size_t> {};

TEST_P(ExplorationOfSeveralAccidents, KeepsEveryPromise) {
  for (std::uint64_t seed = 0; seed < 15; ++seed) {
    const ExploredWorld world{.datagrams = seed % 2 == 1, .rekey = seed % 3 == 1};
    const auto mishaps = RandomMishaps(world, GetParam(), seed);
    EXPECT_EQ(mishaps.size(), GetParam());
    EXPECT_THAT(ExploredRun(world, mishaps).Run(), IsEmpty()) << TextOf(mishaps);
  }
}

INSTANTIATE_TEST_SUITE_P(Accidents, ExplorationOfSeveralAccidents, testing::Values(2, 3, 5, 8));

}  // namespace
}  // namespace priamos::bus::radio
