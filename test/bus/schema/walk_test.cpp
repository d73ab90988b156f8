#include "bus/schema/walk.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>

#include "bus/type_files.hpp"
#include "encoding.hpp"
#include "foreign_messages.hpp"
#include "lcmtypes/embedded_types.hpp"
#include "priamos/landmark_model_t.hpp"
#include "priamos/pose_t.hpp"

namespace priamos::bus {
namespace {

Schema Foreign() {
  return Schema(ReadTypeFiles(PRIAMOS_SOURCE_DIR "/test/bus/schema/foreign"));
}

WalkError ErrorOf(const Struct& type, const Bytes& bytes) {
  return Walk(type, bytes).error;
}

TEST(Walk, PassesWhatLcmGenEncodes) {
  const Schema own = Schema::FromTexts(EmbeddedTypes());
  EXPECT_TRUE(Walk(*own.Find("priamos.pose_t"), Encode(pose_t{})));
  landmark_model_t model{};
  model.n_edges = 3;
  model.edges.resize(3);
  EXPECT_TRUE(Walk(*own.Find("priamos.landmark_model_t"), Encode(model)));
  const Schema foreign = Foreign();
  EXPECT_TRUE(Walk(*foreign.Find("everything_t"), Encode(FullMessage())));
}

TEST(Walk, RefusesEveryTruncationAndAnyTrailingByte) {
  const Schema schema = Foreign();
  const Struct& type = *schema.Find("everything_t");
  Bytes bytes = Encode(FullMessage());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(Walk(type, std::span(bytes).first(size))) << size;
  }
  bytes.push_back(std::byte{0});
  EXPECT_EQ(ErrorOf(type, bytes), WalkError::kTrailing);
}

TEST(Walk, RefusesAFixedMessageOfAnotherLength) {
  const Schema schema = Schema::FromTexts(EmbeddedTypes());
  Bytes bytes = Encode(pose_t{});
  bytes.push_back(std::byte{0});
  EXPECT_EQ(ErrorOf(*schema.Find("pose_t"), bytes), WalkError::kTrailing);
  bytes.resize(bytes.size() - 2);
  EXPECT_EQ(ErrorOf(*schema.Find("pose_t"), bytes), WalkError::kTruncated);
}

TEST(Walk, RefusesAnotherFingerprint) {
  const Schema schema = SchemaOf("struct a { int8_t x; } struct b { int8_t y; }");
  const Bytes bytes = MessageBuilder(*schema.Find("a")).Put<std::int8_t>(1).bytes();
  EXPECT_TRUE(Walk(*schema.Find("a"), bytes));
  EXPECT_EQ(ErrorOf(*schema.Find("b"), bytes), WalkError::kWrongFingerprint);
}

TEST(Walk, RefusesBadCounts) {
  const Schema schema = SchemaOf("struct s { int64_t n; int32_t a[n]; }");
  const Struct& dut = *schema.Find("s");
  const auto with_count = [&](std::int64_t n) {
    return ErrorOf(dut, MessageBuilder(dut).Put(n).Put<std::int32_t>(1).Put<std::int32_t>(2).bytes());
  };
  EXPECT_EQ(with_count(2), WalkError::kNone);
  EXPECT_EQ(with_count(1), WalkError::kTrailing);
  EXPECT_EQ(with_count(3), WalkError::kHugeCount);
  EXPECT_EQ(with_count(-1), WalkError::kNegativeCount);
  EXPECT_EQ(with_count(std::numeric_limits<std::int64_t>::max()), WalkError::kHugeCount);
  EXPECT_EQ(with_count(std::int64_t{1} << 62), WalkError::kHugeCount);  // times 4 bytes overflows
}

TEST(Walk, RefusesAProductOfCountsThatOverflows) {
  const Schema schema = SchemaOf("struct s { int64_t n; int64_t m; byte a[n][m]; }");
  const Struct& dut = *schema.Find("s");
  const auto with = [&](std::int64_t n, std::int64_t m) {
    return ErrorOf(dut, MessageBuilder(dut).Put(n).Put(m).bytes());
  };
  EXPECT_EQ(with(std::int64_t{1} << 32, std::int64_t{1} << 32), WalkError::kHugeCount);
  EXPECT_EQ(with(0, std::int64_t{1} << 40), WalkError::kNone);
  EXPECT_EQ(with(1000, 0), WalkError::kNone);
  EXPECT_EQ(with(std::int64_t{1} << 40, 0), WalkError::kHugeCount);  // rows without bytes are memory too
}

TEST(Walk, RefusesTooManyElementsWithoutBytes) {
  const Schema schema = SchemaOf("struct s { int32_t n; e a[n]; } struct e { }");
  const Struct& dut = *schema.Find("s");
  EXPECT_TRUE(Walk(dut, MessageBuilder(dut).Put<std::int32_t>(kMaxEmptyElements).bytes()));
  EXPECT_EQ(ErrorOf(dut, MessageBuilder(dut).Put<std::int32_t>(kMaxEmptyElements + 1).bytes()),
            WalkError::kHugeCount);
}

/// A few lines of text can define messages of 8 bytes that are billions of values once they are decoded.
TEST(Walk, RefusesTypesWhoseMessagesHoldBillionsOfStructsWithoutBytes) {
  std::string text =
      "struct e_t {} struct wide_t { e_t x[2000000000]; } struct wider_t { wide_t x[2000000000]; }"
      "struct rows_t { int8_t n; e_t x[n]; c15_t c; } struct some_t { int32_t n; c20_t x[n]; } struct c45_t "
      "{}";
  for (int i = 44; i >= 0; --i) text += fmt::format("struct c{0}_t {{ c{1}_t a; c{1}_t b; }}", i, i + 1);
  const Schema schema = SchemaOf(text);
  for (const std::string type : {"wide_t", "wider_t", "c0_t", "c29_t"})
    EXPECT_EQ(ErrorOf(*schema.Find(type), MessageBuilder(*schema.Find(type)).bytes()), WalkError::kHugeCount)
        << type;
  for (const std::string type : {"e_t", "c31_t", "c45_t"})
    EXPECT_TRUE(Walk(*schema.Find(type), MessageBuilder(*schema.Find(type)).bytes())) << type;
  const Struct& rows = *schema.Find("rows_t");
  EXPECT_EQ(ErrorOf(rows, MessageBuilder(rows).Put<std::int8_t>(1).bytes()), WalkError::kHugeCount);
  const Struct& some = *schema.Find("some_t");
  EXPECT_EQ(ErrorOf(some, MessageBuilder(some).Put<std::int32_t>(1).bytes()), WalkError::kHugeCount);
  EXPECT_TRUE(Walk(some, MessageBuilder(some).Put<std::int32_t>(0).bytes()));
}

TEST(Walk, ManyEmptyArraysAreNoTrick) {
  const Schema schema = SchemaOf("struct s { int32_t n; e a[n]; } struct e { int8_t m; byte b[m]; }");
  const Struct& dut = *schema.Find("s");
  MessageBuilder builder(dut);
  builder.Put<std::int32_t>(2 * kMaxEmptyElements);
  for (int i = 0; i < 2 * kMaxEmptyElements; ++i) builder.Put<std::int8_t>(0);
  EXPECT_TRUE(Walk(dut, builder.bytes()));
}

TEST(Walk, RefusesBadStrings) {
  const Schema schema = SchemaOf("struct s { string a; }");
  const Struct& dut = *schema.Find("s");
  const auto with = [&](std::int32_t length, char last) {
    return ErrorOf(dut, MessageBuilder(dut).Put(length).Put('a').Put(last).bytes());
  };
  EXPECT_EQ(with(2, '\0'), WalkError::kNone);
  EXPECT_EQ(with(2, 'b'), WalkError::kUnterminated);
  EXPECT_EQ(with(1, '\0'), WalkError::kUnterminated);
  EXPECT_EQ(with(0, '\0'), WalkError::kBadStringLength);
  EXPECT_EQ(with(-1, '\0'), WalkError::kBadStringLength);
  EXPECT_EQ(with(3, '\0'), WalkError::kBadStringLength);
  EXPECT_EQ(with(std::numeric_limits<std::int32_t>::max(), '\0'), WalkError::kBadStringLength);
  EXPECT_EQ(ErrorOf(dut, MessageBuilder(dut).Put<std::int16_t>(1).bytes()), WalkError::kTruncated);
}

TEST(Walk, LimitsTheDepthOfRecursion) {
  const Schema schema = SchemaOf("struct s { int8_t n; s child[n]; } struct endless { endless e; }");
  const Struct& dut = *schema.Find("s");
  const auto nested = [&](int depth) {
    MessageBuilder builder(dut);
    for (int i = 1; i < depth; ++i) builder.Put<std::int8_t>(1);
    return ErrorOf(dut, builder.Put<std::int8_t>(0).bytes());
  };
  EXPECT_EQ(nested(kMaxWalkDepth), WalkError::kNone);
  EXPECT_EQ(nested(kMaxWalkDepth + 1), WalkError::kTooDeep);
  EXPECT_EQ(ErrorOf(*schema.Find("endless"), MessageBuilder(*schema.Find("endless")).bytes()),
            WalkError::kTooDeep);
}

TEST(Walk, KeepsTheCountsOfNestedStructsApart) {
  const Schema schema = SchemaOf(
      "struct s { int8_t n; inner i[n]; byte tail[n]; } struct inner { int8_t n; int8_t m; byte b[m][n]; }");
  const Struct& dut = *schema.Find("s");
  MessageBuilder builder(dut);
  builder.Put<std::int8_t>(2);
  builder.Put<std::int8_t>(1).Put<std::int8_t>(3).Put('a').Put('b').Put('c');
  builder.Put<std::int8_t>(0).Put<std::int8_t>(7);
  builder.Put('t').Put('t');
  EXPECT_TRUE(Walk(dut, builder.bytes()));
}

TEST(Walk, SaysWhere) {
  const Schema schema = SchemaOf("struct s { int16_t a; int8_t n; byte b[n]; }");
  const Struct& dut = *schema.Find("s");
  const WalkResult result = Walk(dut, MessageBuilder(dut).Put<std::int16_t>(0).Put<std::int8_t>(-3).bytes());
  EXPECT_EQ(result.error, WalkError::kNegativeCount);
  EXPECT_EQ(result.offset, 10u);
  EXPECT_EQ(Sentence(result.error), "the count of an array is negative");
}

}  // namespace
}  // namespace priamos::bus
