#include "common/text/text_hash.hpp"

#include <gtest/gtest.h>

namespace priamos {
namespace {

// The test vectors that are published with FNV-1a.
static_assert(TextHash32("") == 0x811c9dc5U);
static_assert(TextHash64("") == 0xcbf29ce484222325U);

TEST(TextHash, HasThePublishedValues) {
  EXPECT_EQ(TextHash32("a"), 0xe40c292cU);
  EXPECT_EQ(TextHash32("foobar"), 0xbf9cf968U);
  EXPECT_EQ(TextHash64("a"), 0xaf63dc4c8601ec8cU);
  EXPECT_EQ(TextHash64("foobar"), 0x85944171f73967e8U);
}

TEST(TextHash, TakesBytesBeyondAsciiAsTheyAre) {
  EXPECT_EQ(TextHash32("\xff"), (0x811c9dc5U ^ 0xffU) * 0x01000193U);
}

}  // namespace
}  // namespace priamos
