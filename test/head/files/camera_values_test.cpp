#include "head/files/camera_values.hpp"

#include <gmock/gmock.h>

#include "test/support/thrown_reason.hpp"

namespace priamos::head {
namespace {

using testing::ElementsAre;

const CameraValues kDut{"left.yaml",
                        {{"f", 1, {"2.5"}},
                         {"m", 2, {}},
                         {"m/data", 3, {"1", "-2e1", "+3"}},
                         {"w", 4, {"nan"}},
                         {"a/f", 5, {"7"}}}};

TEST(CameraValues, AMatrixHasItsNumbersInData) {
  EXPECT_THAT(kDut.Numbers("", {"m"}, 3), ElementsAre(1, -20, 3));
  EXPECT_EQ(kDut.Find("", {"m"})->key, "m/data");
}

TEST(CameraValues, TheFirstKeyThatIsThereCounts) {
  EXPECT_EQ(kDut.Number("", {"none", "f"}), 2.5);
  EXPECT_EQ(kDut.Number("a", {"f"}), 7);
  EXPECT_FALSE(kDut.Has("a", {"m"}));
}

TEST(CameraValues, WhatIsNotThereIsNamed) {
  const auto reason = [](std::initializer_list<const char*> keys, std::size_t count) {
    return support::ThrownReason([&] { kDut.Numbers("", keys, count); });
  };
  EXPECT_EQ(reason({"x", "y"}, 9), "left.yaml: x: expected 9 numbers, got none");
  EXPECT_EQ(reason({"m"}, 9), "left.yaml:3: m/data: expected 9 numbers, got 3");
  EXPECT_EQ(reason({"w"}, 1), "left.yaml:4: w: expected a number, got \"nan\"");
}

}  // namespace
}  // namespace priamos::head
