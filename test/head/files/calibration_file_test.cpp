#include "head/files/calibration_file.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "common/config.hpp"
#include "test/support/temporary_folder.hpp"
#include "test/support/thrown_reason.hpp"

namespace priamos::head {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class CalibrationFileTest : public testing::Test {
 protected:
  static HeadModel Model(double focal_px) {
    HeadModel model;
    for (int c = 0; c < kCameras; ++c)
      model.lenses[c] = LensTable({0}, {0}, {{focal_px, {386, 285}, -0.05, 0.01, 0.02}});
    return model;
  }
  static std::string Text(const std::string& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }
  /// Why the table is refused; the type must be the one that is promised.
  static std::string ReasonOf(const std::string& file) {
    try {
      LoadHeadModel(file);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder_;
  const std::string table_ = folder_ / "kastor.yaml";
};

TEST_F(CalibrationFileTest, WhatWasSavedIsLoaded) {
  HeadModel model = Model(912.25);
  model.geometry.yaw_rad = 0.0123;
  SaveHeadModel(table_, model);
  const HeadModel dut = LoadHeadModel(table_);
  EXPECT_EQ(dut.geometry.yaw_rad, 0.0123);
  for (int c = 0; c < kCameras; ++c) {
    ASSERT_EQ(dut.lenses[c].nodes().size(), 1u);
    EXPECT_EQ(dut.lenses[c].nodes()[0].focal_px, 912.25);
    EXPECT_EQ(dut.lenses[c].nodes()[0].k2, 0.01);
  }
}

TEST_F(CalibrationFileTest, ANewTableReplacesTheOldOneAndNothingElseIsLeft) {
  SaveHeadModel(table_, Model(900));
  SaveHeadModel(table_, Model(950));
  EXPECT_EQ(LoadHeadModel(table_).lenses[kLeft].nodes()[0].focal_px, 950);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 1);
}

TEST_F(CalibrationFileTest, WhenTheNewOneCannotBeWrittenTheOldOneStays) {
  SaveHeadModel(table_, Model(900));
  const std::string before = Text(table_);
  fs::create_directory(table_ + ".new");  // in the way of the write
  EXPECT_THROW(SaveHeadModel(table_, Model(950)), std::runtime_error);
  EXPECT_EQ(Text(table_), before);
}

TEST_F(CalibrationFileTest, AFolderThatIsNotThereIsNamed) {
  const std::string file = folder_ / "none/kastor.yaml";
  EXPECT_THAT(support::ThrownReason([&] { SaveHeadModel(file, Model(900)); }),
              AllOf(StartsWith(file), HasSubstr("cannot be written")));
}

TEST_F(CalibrationFileTest, AMissingTableIsRefusedWithTheCommandThatMakesOne) {
  const auto reason =
      testing::AllOf(StartsWith(table_ + ": expected a calibration table, got no readable file; "),
                     HasSubstr("`priamos-head --calibrate`"), HasSubstr("`priamos calibrate`"));
  EXPECT_THAT(ReasonOf(table_), reason);
  fs::create_directory(table_);
  EXPECT_THAT(ReasonOf(table_), reason) << "a folder is no table";
}

TEST_F(CalibrationFileTest, ADamagedTableIsRefusedWithReasonAndCommand) {
  SaveHeadModel(table_, Model(900));
  const std::string whole = Text(table_);
  std::ofstream(table_) << whole.substr(0, whole.size() / 2);
  EXPECT_THAT(ReasonOf(table_), AllOf(StartsWith(table_ + ": "), HasSubstr("--calibrate")));
  std::ofstream(table_) << "hello";
  EXPECT_THAT(ReasonOf(table_), AllOf(StartsWith(table_ + ": "), HasSubstr("--calibrate")));
}

}  // namespace
}  // namespace priamos::head
