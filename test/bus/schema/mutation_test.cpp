#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "allocations.hpp"
#include "bus/schema/json.hpp"
#include "bus/schema/packing.hpp"
#include "bus/schema/walk.hpp"
#include "bus/type_files.hpp"
#include "encoding.hpp"
#include "foreign_messages.hpp"
#include "lcmtypes/channels.hpp"
#include "lcmtypes/embedded_types.hpp"
#include "mutator.hpp"
#include "no_package_t.hpp"
#include "random_message.hpp"

namespace priamos::bus {
namespace {

/// PRIAMOS_MUTATIONS=1000000 makes it a long run.
int MutationsPerType() {
  const char* wanted = std::getenv("PRIAMOS_MUTATIONS");
  return wanted != nullptr ? std::atoi(wanted) : 20000;
}

constexpr std::size_t kMegabyte = 1 << 20;

struct Outcome {
  int refused = 0;
  int decoded = 0;
};

/// `decode` is lcm-gen's decoder: the number of bytes it took.
Outcome FeedMutants(const Struct& type, const std::function<int(const Bytes&)>& decode, std::uint64_t seed) {
  Rng rng(seed);
  Outcome outcome;
  for (int i = 0; i < MutationsPerType(); ++i) {
    Bytes bytes = RandomMessage(type, Values::kAny, rng);
    for (std::uint64_t n = 1 + rng.Below(3); n > 0; --n) Mutate(bytes, rng);
    Allocations::Reset();
    const bool passed = static_cast<bool>(Walk(type, bytes));
    EXPECT_EQ(Allocations::SinceReset().count, 0u);
    ++(passed ? outcome.decoded : outcome.refused);
    if (!passed) continue;
    EXPECT_EQ(decode(bytes), static_cast<int>(bytes.size()));
    EXPECT_LT(Allocations::SinceReset().bytes, kMegabyte);
    if (i % 16 == 0) {
      EXPECT_EQ(FromJson(type, ToJson(type, bytes)).size(), bytes.size());
    }
  }
  return outcome;
}

template <class T>
void FeedMutantsOf(const Schema& schema, std::uint64_t seed) {
  const Struct* type = schema.Find(static_cast<std::uint64_t>(T::getHash()));
  ASSERT_NE(type, nullptr);
  const Outcome outcome = FeedMutants(
      *type,
      [](const Bytes& bytes) {
        T message;
        return message.decode(bytes.data(), 0, static_cast<int>(bytes.size()));
      },
      seed);
  // Mutants that are still messages have to be among them, and such that are not.
  EXPECT_GT(outcome.decoded, MutationsPerType() / 100) << type->full_name;
  EXPECT_GT(outcome.refused, MutationsPerType() / 100) << type->full_name;
}

TEST(Mutation, OfEveryChannelsTypeIsRefusedOrDecodable) {
  const Schema schema = Schema::FromTexts(EmbeddedTypes());
  std::uint64_t seed = 1;
  std::apply(
      [&](const auto&... channel) {
        (FeedMutantsOf<typename std::decay_t<decltype(channel)>::Message>(schema, seed++), ...);
      },
      channels::kAll);
}

TEST(Mutation, OfForeignTypesIsRefusedOrDecodable) {
  const Schema schema(ReadTypeFiles(PRIAMOS_SOURCE_DIR "/test/bus/schema/foreign"));
  FeedMutantsOf<foreign::deep::everything_t>(schema, 1);
  FeedMutantsOf<foreign::deep::tree_t>(schema, 2);
  FeedMutantsOf<no_package_t>(schema, 3);
}

TEST(Mutation, RandomBytesBehindTheFingerprintAreRefusedOrDecodable) {
  const Schema schema(ReadTypeFiles(PRIAMOS_SOURCE_DIR "/test/bus/schema/foreign"));
  const Struct& type = *schema.Find("tree_t");
  Rng rng(1);
  int passed = 0;
  for (int i = 0; i < MutationsPerType(); ++i) {
    MessageBuilder builder(type);
    for (std::uint64_t n = rng.Below(30); n > 0; --n) {
      builder.Put(static_cast<std::uint8_t>(rng.Chance(0.9) ? 0 : rng.Chance(0.8) ? 1 : rng.Below(256)));
    }
    Allocations::Reset();
    if (!Walk(type, builder.bytes())) continue;
    ++passed;
    Decode<foreign::deep::tree_t>(builder.bytes());
    EXPECT_LT(Allocations::SinceReset().bytes, kMegabyte);
  }
  EXPECT_GT(passed, 0);
}

TEST(Mutation, OfPackedMessagesIsRefusedOrGivesAMessageThatPacksTheSame) {
  const Schema schema = Schema::FromTexts(EmbeddedTypes());
  Rng rng(1);
  for (const Struct* type : schema.All()) {
    const Packer packer(*type);
    for (int i = 0; i < MutationsPerType() / 4; ++i) {
      Bytes bytes = packer.Pack(RandomMessage(*type, Values::kInRange, rng), 0)->bytes;
      Mutate(bytes, rng);
      Allocations::Reset();
      const auto message = packer.Unpack(bytes, 0);
      EXPECT_LT(Allocations::SinceReset().bytes, kMegabyte);
      if (!message) continue;
      EXPECT_TRUE(Walk(*type, *message));
      EXPECT_EQ(packer.Pack(*message, 0)->bytes, bytes);
    }
  }
}

}  // namespace
}  // namespace priamos::bus
