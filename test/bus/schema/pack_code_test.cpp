#include "bus/schema/pack_code.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>

namespace priamos::bus {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr auto kMin = std::numeric_limits<std::int64_t>::min();
constexpr auto kMax = std::numeric_limits<std::int64_t>::max();

TEST(RealCode, RoundsToTheNearestStep) {
  const RealCode dut(-1.5, 1.5, 0.01, std::nullopt);
  EXPECT_EQ(dut.last(), 300u);
  EXPECT_EQ(dut.Encode(-1.5).code, 0u);
  EXPECT_EQ(dut.Encode(0.004).code, 150u);
  EXPECT_EQ(dut.Encode(0.006).code, 151u);
  EXPECT_EQ(dut.Encode(1.5).code, 300u);
}

TEST(RealCode, DecodesToTheDoubleAPersonWouldWrite) {
  const RealCode dut(-100, 100, 0.01, std::nullopt);
  for (const double value : {0.0, 0.3, -0.07, 99.99, -100.0, 1.1})
    EXPECT_EQ(dut.Decode(dut.Encode(value).code), value);
}

TEST(RealCode, SaturatesAndSaysSo) {
  const RealCode dut(-1, 2, 0.1, std::nullopt);
  for (const double high : {2.06, 1e300, kInf}) {
    EXPECT_EQ(dut.Decode(dut.Encode(high).code), 2);
    EXPECT_TRUE(dut.Encode(high).saturated);
  }
  for (const double low : {-1.06, -1e300, -kInf}) {
    EXPECT_EQ(dut.Decode(dut.Encode(low).code), -1);
    EXPECT_TRUE(dut.Encode(low).saturated);
  }
  // Not beyond half a step: the error is the one that rounding makes everywhere.
  EXPECT_FALSE(dut.Encode(2.04).saturated);
  EXPECT_FALSE(dut.Encode(-1.04).saturated);
}

TEST(RealCode, NanBecomesTheValueNearestToZeroAndIsReported) {
  for (const auto& [min, max, expected] : {std::tuple{-1.0, 1.0, 0.0}, {2.0, 3.0, 2.0}, {-3.0, -2.0, -2.0}}) {
    const RealCode dut(min, max, 0.5, std::nullopt);
    EXPECT_EQ(dut.Decode(dut.Encode(kNan).code), expected);
    EXPECT_TRUE(dut.Encode(kNan).saturated);
  }
}

TEST(RealCode, InvalidHasItsOwnCode) {
  const RealCode dut(0, 5, 0.01, -1);
  EXPECT_EQ(dut.last(), 501u);
  EXPECT_EQ(dut.Encode(-1).code, 501u);
  EXPECT_FALSE(dut.Encode(-1).saturated);
  EXPECT_EQ(dut.Decode(501), -1);
  EXPECT_EQ(dut.Decode(dut.Encode(kNan).code), -1);
  EXPECT_FALSE(dut.Encode(kNan).saturated);
  EXPECT_TRUE(dut.Encode(-2).saturated);
  EXPECT_EQ(dut.Decode(dut.Encode(-2).code), 0);
}

TEST(RealCode, ARangeThatIsNoMultipleOfTheStepKeepsItsBounds) {
  const RealCode up(0, 1.1, 0.3, std::nullopt);
  EXPECT_EQ(up.Decode(up.Encode(1.1).code), 1.1);
  EXPECT_FALSE(up.Encode(1.1).saturated);
  const RealCode down(0, 1, 0.3, std::nullopt);
  EXPECT_NEAR(down.Decode(down.Encode(1).code), 1, 0.15);
  EXPECT_FALSE(down.Encode(1).saturated);
}

TEST(RealCode, KeepsHalfAStepForAnyRange) {
  EXPECT_TRUE(rc::check([](std::int32_t a, std::uint16_t width, std::uint16_t divisor, std::uint32_t where) {
    const double step = 1.0 / (1 + divisor);
    const double min = a * 1e-3;
    const double max = min + (1 + width) * 1e-2;
    const RealCode dut(min, max, step, std::nullopt);
    const double value = min + (max - min) * (where / 4294967295.0);
    const Coded coded = dut.Encode(value);
    const double back = dut.Decode(coded.code);
    RC_ASSERT(coded.code <= dut.last());
    RC_ASSERT(!coded.saturated);
    RC_ASSERT(std::abs(back - value) <= step * 0.50001 + 1e-9);
    RC_ASSERT(back >= min && back <= max);
    RC_ASSERT(dut.Encode(back).code == coded.code);
  }));
}

TEST(RealCode, AStepThatIsNearlyTheInverseOfAWholeNumberIsNotTakenForIt) {
  const RealCode dut(0, 1e7, 0.9999995, std::nullopt);
  EXPECT_FALSE(dut.Encode(1e7).saturated);
  EXPECT_NEAR(dut.Decode(dut.Encode(9999999.6).code), 9999999.6, 0.51);
}

TEST(IntegerCode, IsExactOverAllOfInt64) {
  const IntegerCode dut(kMin, kMax, 1, std::nullopt);
  EXPECT_EQ(dut.last(), ~std::uint64_t{0});
  for (const std::int64_t value : {kMin, kMin + 1, std::int64_t{-1}, std::int64_t{0}, kMax - 1, kMax}) {
    EXPECT_EQ(dut.Decode(dut.Encode(value).code), value);
    EXPECT_FALSE(dut.Encode(value).saturated);
  }
  EXPECT_TRUE(IntegerCode::Fits(kMin, kMax, 1, false));
  EXPECT_FALSE(IntegerCode::Fits(kMin, kMax, 1, true));
  EXPECT_TRUE(IntegerCode::Fits(kMin, kMax, 2, true));
}

TEST(IntegerCode, SaturatesAndSaysSo) {
  const IntegerCode dut(-5, 10, 1, 99);
  EXPECT_EQ(dut.Decode(dut.Encode(kMin).code), -5);
  EXPECT_TRUE(dut.Encode(kMin).saturated);
  EXPECT_EQ(dut.Decode(dut.Encode(kMax).code), 10);
  EXPECT_TRUE(dut.Encode(11).saturated);
  EXPECT_EQ(dut.Encode(99).code, 16u);
  EXPECT_EQ(dut.Decode(16), 99);
  EXPECT_EQ(dut.last(), 16u);
}

TEST(IntegerCode, RoundsUpWhenAskedTo) {
  const IntegerCode dut(0, 500, 100, std::nullopt);
  EXPECT_EQ(dut.EncodeUp(-1).code, 0u);
  EXPECT_EQ(dut.EncodeUp(0).code, 0u);
  EXPECT_EQ(dut.EncodeUp(1).code, 1u);
  EXPECT_EQ(dut.EncodeUp(100).code, 1u);
  EXPECT_EQ(dut.EncodeUp(499).code, 5u);
  EXPECT_FALSE(dut.EncodeUp(500).saturated);
  EXPECT_TRUE(dut.EncodeUp(501).saturated) << "comes back smaller";
}

TEST(IntegerCode, KeepsHalfAStepForAnyRange) {
  EXPECT_TRUE(rc::check([](std::int64_t a, std::int64_t b, std::uint64_t step, std::uint64_t where) {
    RC_PRE(a != b && step != 0);
    const std::int64_t min = std::min(a, b);
    const std::int64_t max = std::max(a, b);
    const IntegerCode dut(min, max, step, std::nullopt);
    const std::uint64_t span = static_cast<std::uint64_t>(max) - static_cast<std::uint64_t>(min);
    const std::uint64_t offset = span == ~std::uint64_t{0} ? where : where % (span + 1);
    const auto value = static_cast<std::int64_t>(static_cast<std::uint64_t>(min) + offset);
    const Coded coded = dut.Encode(value);
    const std::int64_t back = dut.Decode(coded.code);
    RC_ASSERT(!coded.saturated && coded.code <= dut.last());
    RC_ASSERT(back >= min && back <= max);
    const std::uint64_t error = back > value
                                    ? static_cast<std::uint64_t>(back) - static_cast<std::uint64_t>(value)
                                    : static_cast<std::uint64_t>(value) - static_cast<std::uint64_t>(back);
    RC_ASSERT(error <= step / 2);
  }));
}

}  // namespace
}  // namespace priamos::bus
