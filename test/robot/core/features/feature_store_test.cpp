#include "robot/core/features/feature_store.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace priamos::robot {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

/// A straight wall 1.5 m to the left of a base that drives along x, from 0 to `to_m`.
FoundSegment Found(int number, double to_m, Time heard) {
  std::vector<PlacedEcho> echoes;
  for (double x = 0; x < to_m; x += 0.05)
    echoes.push_back({{x, 0, 0}, {x, 0.39, kPi / 2}, 1.11 + 10 * number, x});
  return {number, heard, WallSegment({}, {}, echoes, FitSegment(echoes, kPi / 2, {}, {}).value())};
}

class FeatureStoreTest : public testing::Test {
 protected:
  Whereabouts Base() const {
    return {{0, 0, 0}, Eigen::Vector3d(1e-4, 1e-4, 1e-5).asDiagonal(), {0, 0, 0}, 0};
  }
  void Hear(int number, double to_m = 1) { dut_.Note(Found(number, to_m, now_), Base()); }
  /// The numbers of what is told in `seconds`.
  std::vector<int> Told(double seconds, bool acknowledge) {
    std::vector<int> told;
    for (const Time end = now_ + FromSeconds(seconds); now_ < end; now_ += FromSeconds(0.5)) {
      const auto batch = dut_.Next(Base(), now_);
      if (!batch) continue;
      EXPECT_THAT(batch->features, SizeIs(testing::Le(FeatureStore::kBatch)));
      for (const Feature& feature : batch->features) told.push_back(feature.id);
      if (acknowledge) dut_.Acknowledge(batch->store, batch->batch, 0);
    }
    return told;
  }

  Time now_ = FromUtime(1'000'000'000);
  FeatureStore dut_{{}, {}, 77};
};

TEST_F(FeatureStoreTest, WhatIsNewIsToldOnce) {
  EXPECT_THAT(Told(10, true), IsEmpty());
  for (const int number : {1, 2, 3, 4}) Hear(number);
  EXPECT_THAT(Told(60, true), testing::UnorderedElementsAre(1, 2, 3, 4));
}

TEST_F(FeatureStoreTest, WhatHasGoneIsToldUntilItIsAcknowledged) {
  FoundPoint point;
  point.number = 1;
  point.heard = now_;
  point.fit.covariance *= 1e-4;
  dut_.Note(point, Base());
  Hear(1);
  EXPECT_THAT(Told(20, true), testing::UnorderedElementsAre(1, 2));
  dut_.NoteGone(1);
  now_ += FromSeconds(10);
  const auto batch = dut_.Next(Base(), now_);
  ASSERT_TRUE(batch);
  ASSERT_THAT(batch->features, SizeIs(1));
  EXPECT_EQ(batch->features[0].id, 1);
  EXPECT_TRUE(batch->features[0].gone);
  EXPECT_THAT(Told(40, false), testing::Contains(1));
  Told(20, true);
  EXPECT_THAT(Told(60, true), IsEmpty());
  EXPECT_EQ(dut_.size(), 1U) << "the wall";
}

TEST_F(FeatureStoreTest, WhatHasGoneBeforeItWasToldIsNothing) {
  FoundPoint point;
  point.number = 1;
  point.heard = now_;
  point.fit.covariance *= 1e-4;
  dut_.Note(point, Base());
  dut_.NoteGone(1);
  dut_.NoteGone(2);
  EXPECT_THAT(Told(60, true), IsEmpty());
}

TEST_F(FeatureStoreTest, WhatIsNotAcknowledgedIsToldAgain) {
  Hear(1);
  EXPECT_THAT(Told(50, false), SizeIs(testing::Ge(3u)));
  EXPECT_THAT(Told(20, true), SizeIs(testing::Le(2u)));
  EXPECT_THAT(Told(60, true), IsEmpty());
}

TEST_F(FeatureStoreTest, ALostAcknowledgementIsMadeUpByTheNextOnes) {
  std::vector<int> batches;
  for (int number = 1; number <= 3; ++number) {
    Hear(number);
    now_ += FromSeconds(4);
    batches.push_back(dut_.Next(Base(), now_)->batch);
  }
  // The newest, and of those before it all but the last one.
  dut_.Acknowledge(77, batches.back(), 0xff & ~0x1U);
  EXPECT_THAT(Told(20, true), testing::ElementsAre(2));
}

TEST_F(FeatureStoreTest, AWallThatGrewIsToldAgainUnderItsNumber) {
  Hear(1);
  EXPECT_THAT(Told(10, true), SizeIs(1));
  Hear(1, 1.5);
  EXPECT_THAT(Told(2.5, true), IsEmpty()) << "a little";
  Hear(1, 2.2);
  EXPECT_THAT(Told(3, true), SizeIs(1));
  Hear(1, 2.7);
  EXPECT_THAT(Told(20, true), SizeIs(1)) << "and once when it grows no more";
}

TEST_F(FeatureStoreTest, AnAcknowledgementOfAnotherStoreOrBatchSaysNothing) {
  Hear(1);
  const auto batch = dut_.Next(Base(), now_);
  dut_.Acknowledge(78, batch->batch, 0xff);
  dut_.Acknowledge(77, batch->batch + 1, 0);
  dut_.Acknowledge(77, -5, 0);
  EXPECT_THAT(Told(20, true), SizeIs(1));
}

TEST_F(FeatureStoreTest, APlannerThatHasNothingIsToldAll) {
  for (const int number : {1, 2, 3, 4, 5}) Hear(number);
  Told(60, true);
  dut_.Acknowledge(0, 0, 0);
  EXPECT_THAT(Told(60, true), SizeIs(5));
}

TEST_F(FeatureStoreTest, WhatWasToldGoesFirstWhenThereIsNoRoom) {
  for (int number = 1; number <= 100; ++number) Hear(number);
  Told(300, true);
  for (int number = 101; number <= 300; ++number) Hear(number);
  EXPECT_EQ(dut_.size(), 200u);
  EXPECT_EQ(dut_.lost(), 0);
  for (int number = 301; number <= 310; ++number) Hear(number);
  EXPECT_EQ(dut_.size(), 200u);
  EXPECT_EQ(dut_.lost(), 10);
}

TEST_F(FeatureStoreTest, WhenAllNumbersAreUsedUpANewStoreBegins) {
  for (int number = 1; number <= FeatureStore::kLastId; ++number) Hear(number);
  Told(300, true);
  Hear(FeatureStore::kLastId + 1);
  const auto batch = dut_.Next(Base(), now_ + FromSeconds(5));
  EXPECT_EQ(batch->store, 78);
  EXPECT_EQ(batch->features.at(0).id, 1);
  EXPECT_EQ(dut_.size(), 1u);
}

/// Whatever the radio loses in either direction: once it lets something through, the planner ends up with the
/// newest state of everything.
RC_GTEST_PROP(FeatureStore, ABlackoutLosesNothing, ()) {
  std::mt19937 random(static_cast<unsigned>(*rc::gen::inRange(0, 1 << 30)));
  const auto chance = [&](double p) { return std::uniform_real_distribution<>()(random) < p; };
  const double loss = *rc::gen::inRange(0, 95) / 100.0;
  const Whereabouts base{{}, Eigen::Vector3d(1e-4, 1e-4, 1e-5).asDiagonal(), {}, 0};
  FeatureStore dut({}, {}, 1);
  std::map<int, double> planner, truth;
  Time now = FromUtime(1'000'000'000);
  bool dark = false;
  for (int i = 0; i < 600; ++i, now += FromSeconds(1)) {
    if (i % 40 == 0) dark = chance(0.7) && i < 300;
    if (i < 300 && chance(0.1)) {
      const int number = 1 + static_cast<int>(truth.size()) % 30;
      truth[number] += 1.2;
      dut.Note(Found(number, truth[number], now), base);
    }
    const auto batch = dut.Next(base, now);
    const bool through = !dark && (i >= 300 || !chance(loss));
    if (!batch || !through) continue;
    for (const Feature& feature : batch->features) planner[feature.id] = feature.length_m;
    if (i >= 300 || !chance(loss)) dut.Acknowledge(batch->store, batch->batch, 0);
  }
  RC_ASSERT(planner.size() == truth.size());
  for (const auto& [number, length_m] : truth) RC_ASSERT(std::abs(planner.at(number) - length_m) < 0.11);
  RC_ASSERT(!dut.Next(base, now + FromSeconds(1)).has_value());
}

}  // namespace
}  // namespace priamos::robot
