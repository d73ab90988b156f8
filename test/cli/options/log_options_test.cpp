#include "cli/options/log_options.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "bus/log/log_writer.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

TEST(ParseSpeed, TakesFractionsNumbersAndMax) {
  EXPECT_EQ(ParseSpeed("1/64"), 1.0 / 64);
  EXPECT_EQ(ParseSpeed("2.5"), 2.5);
  EXPECT_EQ(ParseSpeed("max"), 0);
}

TEST(ParseSpeed, RefusesEverythingElse) {
  for (const char* text : {"", "0", "-1", "1/0", "fast", "1/2/3", "1/65", "2000", "nan", "inf"})
    EXPECT_THROW(ParseSpeed(text), std::runtime_error) << text;
}

class SelectionOfTest : public testing::Test {
 protected:
  SelectionOfTest() {
    bus::LogWriter writer(log_);
    writer.Write(5'000'000, "A", {});
  }
  TemporaryFolder folder_;
  std::string log_ = folder_ / "a.lcmlog";
};

TEST_F(SelectionOfTest, TimesBeginWithTheFirstEvent) {
  const auto dut = SelectionOf({.only = {}, .without = {}, .rename = {}, .from_s = 2, .to_s = 3}, log_);
  EXPECT_EQ(dut.from_utime, 7'000'000);
  EXPECT_EQ(dut.to_utime, 8'000'000);
}

TEST_F(SelectionOfTest, RenamesArePairs) {
  EXPECT_EQ(SelectionOf({.only = {}, .without = {}, .rename = {"A=B"}}, log_).NameOf("A"), "B");
  for (const char* text : {"A", "=B", "A="})
    EXPECT_THROW(SelectionOf({.only = {}, .without = {}, .rename = {text}}, log_), std::runtime_error)
        << text;
}

TEST_F(SelectionOfTest, AChannelThatTheLogLacksIsToldWithTheNearest) {
  const std::string log = folder_ / "poses.lcmlog";
  { bus::LogWriter(log).Write(5'000'000, "POSE", {}); }
  testing::internal::CaptureStderr();
  SelectionOf({.only = {"POZE"}, .without = {}, .rename = {}}, log);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            log + " has no channel POZE; nearest: \"POSE\" (priamos log info lists all)\n");
  testing::internal::CaptureStderr();
  SelectionOf({.only = {"POSE", "WHEEL_*"}, .without = {}, .rename = {}}, log);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(SelectionOfTest, WhatIsReadIsNotOverwritten) {
  EXPECT_THROW(RequireNewFile(log_, log_, true), std::runtime_error);
  const std::string other = folder_ / "b";
  EXPECT_NO_THROW(RequireNewFile(other, log_, false));
  std::ofstream(other).close();
  EXPECT_THROW(RequireNewFile(other, log_, false), std::runtime_error);
  EXPECT_NO_THROW(RequireNewFile(other, log_, true));
}

}  // namespace
}  // namespace priamos::cli
