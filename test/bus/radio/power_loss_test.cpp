#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "link_pair.hpp"

// The machine of one end loses its power: of what the end saved, its disk has what was synced. Cut at every
// write in turn.

namespace priamos::bus::radio {
namespace {

using testing::ElementsAre;

/// A disk, and before it a memory that forgets without power.
class PoweredStore : public StateStore {
 public:
  std::optional<SavedState> Load() override {
    if (memory_) return SavedState{.bytes = *memory_, .latest = true};
    if (disk_) return SavedState{.bytes = *disk_, .latest = false};
    return std::nullopt;
  }
  void Save(std::span<const std::byte> state) override {
    memory_.emplace(state.begin(), state.end());
    OnWrite();
  }
  void StartSync() override {
    syncing_ = memory_;
    OnWrite();
  }
  void AwaitSync() override {
    disk_ = syncing_;
    OnWrite();
  }
  /// `finished`: the disk still got what was being synced.
  void LosePower(bool finished) {
    if (finished && syncing_) disk_ = syncing_;
    memory_.reset();
    syncing_.reset();
  }
  int writes() const { return writes_; }

 private:
  void OnWrite() { ++writes_; }
  std::optional<std::vector<std::byte>> memory_, syncing_, disk_;
  int writes_ = 0;
};

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

TEST_F(PowerLoss, AfterAnOrderlyEndTheDiskIsEnough) {
  OfferInSilence("waits");
  pair.offboard.link->Close();
  StartAfterLoss();
  pair.Run(1);
  EXPECT_THAT(pair.onboard.TextsOf(kEventDown), ElementsAre("waits"));
}

TEST_F(PowerLoss, AnOrderlyEndIsForgottenBeforeTheFirstFrameAfterIt) {
  pair.offboard.link->Close();
  pair.Start(pair.offboard);
  pair.offboard.link->Offer(kStopDown, Text("1"), pair.now);
  pair.Run(0.3);
  StartAfterLoss();
  pair.offboard.link->Offer(kStopDown, Text("2"), pair.now);
  pair.Run(0.5);
  EXPECT_THAT(pair.onboard.TextsOf(kStopDown), ElementsAre("1", "2"));
}

}  // namespace
}  // namespace priamos::bus::radio
