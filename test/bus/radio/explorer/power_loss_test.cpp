#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "test/bus/radio/explorer/powered_store.hpp"
#include "test/bus/radio/link_pair.hpp"

// The machine of one end loses its power: of what the end saved, its disk has what was synced. Cut at every
// write in turn.

namespace priamos::bus::radio {
namespace {

using testing::ElementsAre;

/// Stops from the workstation and events of the robot; the power of the workstation is lost after so many
/// writes.
struct PowerLossRun {
  explicit PowerLossRun(int writes, bool finished) {
    pair.offboard.other_store = &store;
    pair.Start(pair.offboard);
    pair.Run(0.5);
    const int before = store.writes();
    for (int i = 0; i < 400 && store.writes() - before < writes; ++i) {
      if (i % 40 == 0) pair.offboard.link->Offer(kStopDown, Text(std::string(1, 'a' + i / 40)), pair.now);
      if (i % 50 == 0) pair.onboard.link->Offer(kEventUp, Text(std::to_string(i)), pair.now);
      pair.Run(0.005);
    }
    store.LosePower(finished);
    pair.Start(pair.offboard);
    heard_before = pair.onboard.TextsOf(kStopDown).size();
    for (const char c : {'X', 'Y', 'Z'}) {
      pair.offboard.link->Offer(kStopDown, Text(std::string(1, c)), pair.now);
      pair.Run(0.4);
    }
  }
  /// Behind what was heard of before; one may have been on the line when the power went.
  std::vector<std::string> NewestThree() const {
    const auto texts = pair.onboard.TextsOf(kStopDown);
    EXPECT_LE(texts.size(), heard_before + 4);
    return {texts.end() - std::min<std::ptrdiff_t>(3, std::ssize(texts)), texts.end()};
  }
  PoweredStore store;
  LinkPair pair{LineConfig{.latency_s = 0.005}};
  std::size_t heard_before = 0;
};

TEST(PowerLossRunTest, NewEventsAreNeverTakenForOldOnesWhereverThePowerIsCut) {
  for (const bool finished : {false, true}) {
    for (int writes = 1; writes <= 40; ++writes) {
      const PowerLossRun dut(writes, finished);
      ASSERT_THAT(dut.NewestThree(), ElementsAre("X", "Y", "Z")) << writes << " writes";
      EXPECT_EQ(dut.pair.offboard.link->waiting(kStopDown), 0U) << "all acknowledged";
      // None twice, none made up.
      auto all = dut.pair.onboard.TextsOf(kStopDown);
      std::sort(all.begin(), all.end());
      EXPECT_EQ(std::adjacent_find(all.begin(), all.end()), all.end()) << writes << " writes";
    }
  }
}

struct PowerLoss : testing::Test {
  PowerLoss() {
    pair.offboard.other_store = &store;
    pair.Start(pair.offboard);
    pair.Run(0.5);
  }
  /// An event that is offered while nothing arrives.
  void OfferInSilence(const std::string& text) {
    pair.lose_down = [](auto) { return true; };
    pair.offboard.link->Offer(kEventDown, Text(text), pair.now);
    pair.Run(0.1);
    pair.lose_down = nullptr;
  }
  void StartAfterLoss() {
    store.LosePower(false);
    pair.Start(pair.offboard);
  }
  PoweredStore store;
  LinkPair pair;
};

TEST_F(PowerLoss, EventsThatWaitedAreCountedAsRefused) {
  OfferInSilence("waits");
  store.StartSync();
  store.AwaitSync();
  StartAfterLoss();
  EXPECT_EQ(pair.offboard.link->sent(kEventDown).refused, 1U);
  pair.offboard.link->Offer(kEventDown, Text("new"), pair.now);
  pair.Run(1);
  EXPECT_THAT(pair.onboard.TextsOf(kEventDown), ElementsAre("new"));
}

TEST_F(PowerLoss, AStateOfAnEarlierOrderlyEndIsNotTrustedEither) {
  pair.offboard.link->Close();
  pair.Start(pair.offboard);
  for (const char* text : {"1", "2", "3"}) pair.offboard.link->Offer(kStopDown, Text(text), pair.now);
  pair.Run(0.3);
  StartAfterLoss();  // as from an image of the disk that is put back at each boot
  for (const char* text : {"4", "5", "6"}) pair.offboard.link->Offer(kStopDown, Text(text), pair.now);
  pair.Run(2);
  EXPECT_THAT(pair.onboard.TextsOf(kStopDown), ElementsAre("1", "2", "3", "4", "5", "6"));
}

/// The robot's power is lost after so many stops since its disk was written.
class ReceiverPowerLoss : public testing::TestWithParam<int> {};

TEST_P(ReceiverPowerLoss, HearsTheNextStopsAtOnce) {
  PoweredStore store;
  LinkPair pair;
  pair.onboard.other_store = &store;
  pair.Start(pair.onboard);
  pair.Run(0.5);
  pair.offboard.link->Offer(kStopDown, Text("first"), pair.now);
  pair.Run(0.2);
  store.StartSync();
  store.AwaitSync();
  const PoweredStore synced = store;
  for (int i = 0; i < GetParam(); ++i) {
    pair.offboard.link->Offer(kStopDown, Text("."), pair.now);
    pair.Run(0.05);
  }
  store = synced;
  store.LosePower(false);
  pair.Start(pair.onboard);
  for (const char* text : {"X", "Y", "Z"}) {
    pair.offboard.link->Offer(kStopDown, Text(text), pair.now);
    pair.Run(0.4);
  }
  const auto texts = pair.onboard.TextsOf(kStopDown);
  ASSERT_GE(texts.size(), 3U);
  EXPECT_THAT(std::vector(texts.end() - 3, texts.end()), ElementsAre("X", "Y", "Z"));
  EXPECT_EQ(pair.offboard.link->waiting(kStopDown), 0U);
}

INSTANTIATE_TEST_SUITE_P(StopsSinceThen, ReceiverPowerLoss,
                         testing::Values(0, 1, 100, 127, 128, 180, 255, 256));

TEST(LinkCrash, AnEventIsNotLostBetweenItsDeliveryAndTheDisk) {
  PoweredStore store;
  LinkPair pair;
  pair.onboard.other_store = &store;
  pair.Start(pair.onboard);
  pair.Run(0.5);
  const auto before = store.Load();
  pair.offboard.link->Offer(kStopDown, Text("!"), pair.now);
  ASSERT_TRUE(pair.RunUntil(1, [&] { return !pair.onboard.received.empty(); }));
  // Killed before it could be handed on: the process knows of it, the disk must not.
  EXPECT_EQ(store.Load(), before);
  pair.onboard.received.clear();
  pair.Start(pair.onboard);
  pair.Run(1);
  EXPECT_THAT(pair.onboard.TextsOf(kStopDown), ElementsAre("!"));
}

/// Of a half-duplex radio a turn may be one frame: repetitions of a stop must not take all of them.
TEST(HalfDuplexRestart, AStopThatWaitsKeepsNobodyFromAgreeing) {
  for (const bool remembers : {false, true}) {
    for (const double turn_s : {0.3, 0.9}) {
      for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        LinkOptions options;
        options.half_duplex = {FromSeconds(turn_s), FromSeconds(0.02)};
        LinkPair pair({.half_duplex = true}, seed, options);
        pair.Run(3 + 0.1 * static_cast<double>(seed));
        LinkPair::End& end = seed % 2 == 0 ? pair.onboard : pair.offboard;
        if (!remembers) end.store.Lose();
        pair.Start(end);
        pair.offboard.link->Offer(kStopDown, Text("!"), pair.now);
        EXPECT_TRUE(pair.RunUntil(4, [&] { return !pair.onboard.TextsOf(kStopDown).empty(); }))
            << remembers << " " << turn_s << " " << seed;
        pair.each_step = [&] {
          if (ToUtime(pair.now) % 100'000 == 0)
            pair.onboard.link->Offer(kPoseUp, Text("0123456789"), pair.now);
        };
        EXPECT_TRUE(pair.RunUntil(4, [&] { return !pair.offboard.TextsOf(kPoseUp).empty(); }))
            << remembers << " " << turn_s << " " << seed;
      }
    }
  }
}

}  // namespace
}  // namespace priamos::bus::radio
