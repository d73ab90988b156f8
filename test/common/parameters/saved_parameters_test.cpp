#include "common/parameters/saved_parameters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace priamos {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

struct Section {
  double speed = 0.6;
  void Describe(Archive& a) { a.Number("speed", speed, {"m/s", 0, 1.5, "fastest"}); }
};
struct Settings {
  Section drive;
  double gap = 0.1, rate = 50;
  void Describe(Archive& a) {
    a.Number("gap", gap, {"m", 0, 1, "distance"});
    a.Number("rate", rate, {"Hz", 0, 100, "not live"});
    a.Section("drive", drive, "a section");
    a.Live("drive.speed", LiveChange::kOnlyLower);
    a.Live("gap", LiveChange::kOnlyHigher);
  }
};

class SavedParametersTest : public testing::Test {
 protected:
  SavedParametersTest() { fs::create_directories(folder_); }
  ~SavedParametersTest() override { fs::remove_all(folder_); }

  std::string Refusal(const std::string& text) {
    std::ofstream(path_) << text;
    try {
      ReadSavedParameters(path_, store_);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_ = fs::path(testing::TempDir()) / ("saved" + std::to_string(getpid()));
  std::string path_ = (folder_ / "robot.toml").string();
  Settings settings_;
  ParameterStore store_{[this](Archive& a) { settings_.Describe(a); }};
};

TEST_F(SavedParametersTest, WhatIsSavedIsInForceAtTheNextStart) {
  store_.Set(1, 0.1 + 0.2);  // needs all digits of a double
  store_.Set(2, 0.25);
  ASSERT_EQ(SaveParameters(path_, store_), "");

  Settings next;
  ParameterStore store([&](Archive& a) { next.Describe(a); });
  ReadSavedParameters(path_, store);
  EXPECT_EQ(next.drive.speed, 0.1 + 0.2);
  EXPECT_EQ(next.gap, 0.25);
  EXPECT_EQ(store.FileValueOf(1), 0.6) << "the limit is still that of the file";
}

TEST_F(SavedParametersTest, NothingToSaveRemovesTheFile) {
  store_.Set(1, 0.3);
  ASSERT_EQ(SaveParameters(path_, store_), "");
  store_.Reset();
  ASSERT_EQ(SaveParameters(path_, store_), "");
  EXPECT_FALSE(fs::exists(path_));
  EXPECT_EQ(SaveParameters(path_, store_), "") << "there is none to remove";
}

TEST_F(SavedParametersTest, NoFileAndNoNameSaveNothing) {
  ReadSavedParameters("", store_);
  ReadSavedParameters(path_, store_);
  EXPECT_EQ(store_.NextChanged(0), 0);
  store_.Set(1, 0.3);
  EXPECT_THAT(SaveParameters("", store_), HasSubstr("--saved"));
  EXPECT_THAT(SaveParameters("/nowhere/at/all.toml", store_), HasSubstr("No such file"));
}

TEST_F(SavedParametersTest, AFileThatCannotBeUsedIsNamedWithItsLine) {
  EXPECT_THAT(Refusal("# head\ndrive.speed = 0.9\n"),
              AllOf(HasSubstr(path_ + ":2:drive.speed"), HasSubstr("less careful"), HasSubstr("0.9")));
  EXPECT_THAT(Refusal("[drive]\nspeed = 7\n"),
              AllOf(HasSubstr(":2:drive.speed"), HasSubstr("out of its range")));
  EXPECT_THAT(Refusal("rate = 20\n"), AllOf(HasSubstr(":1:rate"), HasSubstr("next: remove the line")));
  EXPECT_THAT(Refusal("gap = nan\n"), HasSubstr(":1:gap"));
  EXPECT_THAT(Refusal("gap = \"wide\"\n"), HasSubstr("expected a number"));
  EXPECT_THAT(Refusal("gap = \n"), HasSubstr("expected TOML"));
  EXPECT_THAT(Refusal(std::string(2 << 20, '#')), HasSubstr("expected a file of at most"));
  EXPECT_EQ(settings_.rate, 50);
}

}  // namespace
}  // namespace priamos
