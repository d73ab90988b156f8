#include "cli/options/path_override.hpp"

#include <gtest/gtest.h>

namespace priamos::cli {
namespace {

TEST(PathOverride, MayHaveBlanksAndQuotes) {
  EXPECT_EQ(PathOverride("pictures", "/a b/\"c\""), "pictures=\"/a b/\\\"c\\\"\"");
}

TEST(PathOverride, IsAbsolute) {
  EXPECT_EQ(PathOverride("k", "x"), "k=\"" + (std::filesystem::current_path() / "x").string() + "\"");
}

}  // namespace
}  // namespace priamos::cli
