#include "bus/radio/link_memory.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <optional>
#include <vector>

#include "link_pair.hpp"

namespace priamos::bus::radio {
namespace {

/// A disk that is slow: what was saved is on it only some calls later, unless somebody waits.
class SlowDisk : public StateStore {
 public:
  explicit SlowDisk(int delay) : delay_(delay) {}
  std::optional<SavedState> Load() override {
    if (!saved_) return std::nullopt;
    return SavedState{.bytes = *saved_, .latest = !lost_power_};
  }
  void Save(std::span<const std::byte> state) override {
    saved_.emplace(state.begin(), state.end());
    lost_power_ = false;
  }
  void StartSync() override {
    on_the_way_ = saved_;
    left_ = delay_;
  }
  void AwaitSync() override {
    if (!on_the_way_) return;
    ++waits;
    on_disk_ = std::exchange(on_the_way_, std::nullopt);
  }
  void Step() {
    if (on_the_way_ && --left_ <= 0) on_disk_ = std::exchange(on_the_way_, std::nullopt);
  }
  void LosePower() {
    saved_ = on_disk_;
    lost_power_ = true;
    on_the_way_.reset();
  }

  int waits = 0;

 private:
  bool lost_power_ = false;
  int delay_, left_ = 0;
  std::optional<std::vector<std::byte>> saved_, on_the_way_, on_disk_;
};

struct LinkMemoryTest : testing::Test {
  LinkMemory Start(SlowDisk& disk) {
    return {disk, table, [] { return std::uint64_t{7}; }};
  }
  const ChannelTable table{TestChannels(), false};
};

TEST_F(LinkMemoryTest, NobodyWaitsForADiskThatIsFasterThanTheReserve) {
  SlowDisk disk(50);
  LinkMemory dut = Start(disk);
  dut.ChangeEpoch(1, 2);
  dut.TakeCounter();
  dut.NoteAccepted(1);
  const int before = disk.waits;
  for (std::uint64_t i = 2; i < 5000; ++i) {
    dut.TakeCounter();
    dut.NoteAccepted(i);
    disk.Step();
  }
  EXPECT_EQ(disk.waits, before);
}

TEST_F(LinkMemoryTest, TheKeyOfTheEpochIsKnownAfterARestart) {
  const auto nonces = [] { return std::uint64_t{7}; };
  SlowDisk disk(1);
  Start(disk).ChangeEpoch(1, 2);
  {
    LinkMemory dut(disk, table, nonces, {.current = 5, .next = 6});
    EXPECT_FALSE(dut.under_next_key()) << "before there was a choice";
    EXPECT_EQ(dut.epoch(), 1U);
    dut.UseKey(6);
    dut.ChangeEpoch(3, 2);
  }
  const LinkMemory both(disk, table, nonces, {.current = 5, .next = 6});
  EXPECT_TRUE(both.under_next_key());
  EXPECT_EQ(both.epoch(), 3U);
  const LinkMemory finished(disk, table, nonces, {.current = 6});
  EXPECT_FALSE(finished.under_next_key());
  EXPECT_EQ(finished.epoch(), 3U);
}

TEST_F(LinkMemoryTest, OfAnotherKeyOnlyTheEpochIsForgotten) {
  const auto nonces = [stream = std::uint64_t{7}]() mutable { return stream++; };
  SlowDisk disk(1);
  LinkMemory before(disk, table, nonces, {.current = 5, .next = 6});
  before.ChangeEpoch(1, 2);
  before.TakeCounter();
  before.NoteAccepted(9);
  const LinkMemory dut(disk, table, nonces, {.current = 8, .next = 9});
  EXPECT_EQ(dut.epoch(), 0U);
  EXPECT_EQ(dut.receive_floor(), 0U);
  EXPECT_EQ(dut.last_counter(), 0U);
  EXPECT_EQ(dut.stream(), before.stream()) << "numbers of events go on";
}

/// Whatever the disk does and whenever the process or the power goes: no counter is sent twice in an epoch,
/// and none that was accepted is below what the next start believes.
RC_GTEST_FIXTURE_PROP(LinkMemoryTest, NoCounterIsUsedTwiceHoweverItEnds, ()) {
  SlowDisk disk(*rc::gen::inRange(1, 400));
  std::uint64_t last_sent = 0, last_accepted = 0;
  Start(disk).ChangeEpoch(1, 2);
  for (int run = 0; run < 5; ++run) {
    LinkMemory dut = Start(disk);
    if (dut.epoch() == 0) {
      dut.ChangeEpoch(static_cast<std::uint64_t>(run) + 2, 2);
      last_sent = last_accepted = 0;
    }
    RC_ASSERT(dut.receive_floor() >= last_accepted);
    std::uint64_t next = dut.receive_floor();  // skipped, not accepted: it may be lost again
    const int steps = *rc::gen::inRange(0, 600);
    for (int i = 0; i < steps; ++i) {
      const std::uint64_t sent = dut.TakeCounter();
      RC_ASSERT(sent > last_sent);
      last_sent = sent;
      next += static_cast<std::uint64_t>(*rc::gen::inRange(1, 3));
      dut.NoteAccepted(next);
      last_accepted = next;
      disk.Step();
    }
    if (*rc::gen::arbitrary<bool>()) disk.LosePower();
  }
}

}  // namespace
}  // namespace priamos::bus::radio
