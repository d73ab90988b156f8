#include "head/see/see_output.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "test/support/temporary_folder.hpp"

namespace priamos::head {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class SeeOutputTest : public ::testing::Test {
 protected:
  std::string File(const std::string& name) {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << "x";
    return folder_ / name;
  }

  static std::string ErrorOf(const std::vector<PlannedDrawing>& drawings, const std::string& output = "",
                             bool force = false) {
    std::vector<std::string> inputs;
    for (const auto& drawing : drawings) inputs.push_back(drawing.image);
    try {
      SeeOutput(drawings, inputs, output, force);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder_;
};

TEST_F(SeeOutputTest, DrawingsLieBesideTheirImages) {
  const std::string left = File("left/50.jpg"), right = File("right/50.jpg");
  const SeeOutput dut({{left, "edges"}, {right, "edges"}, {left, "stereo"}}, {left, right}, "", false);
  EXPECT_EQ(dut.FileOf(left, "edges"), folder_ / "left/50-edges.png");
  EXPECT_EQ(dut.FileOf(right, "edges"), folder_ / "right/50-edges.png");
  EXPECT_EQ(dut.FileOf(left, "stereo"), folder_ / "left/50-stereo.png");
}

TEST_F(SeeOutputTest, InOneFolderNamesakesKeepTheirFoldersName) {
  const std::string left = File("left/50.jpg"), right = File("right/50.jpg"), other = File("other.jpg");
  const SeeOutput dut({{left, "edges"}, {right, "edges"}, {other, "edges"}}, {}, folder_.path(), false);
  EXPECT_EQ(dut.FileOf(left, "edges"), folder_ / "left-50-edges.png");
  EXPECT_EQ(dut.FileOf(right, "edges"), folder_ / "right-50-edges.png");
  EXPECT_EQ(dut.FileOf(other, "edges"), folder_ / "other-edges.png");
}

TEST_F(SeeOutputTest, ASingleDrawingMayBeAFile) {
  const std::string image = File("hall.jpg"), out = folder_ / "out.png";
  EXPECT_EQ(SeeOutput({{image, "edges"}}, {}, out, false).FileOf(image, "edges"), out);
  EXPECT_THAT(ErrorOf({{image, "edges"}, {image, "doors"}}, out),
              HasSubstr("expected a folder for 2 drawings"));
}

TEST_F(SeeOutputTest, ATargetThatIsNoneIsNamed) {
  EXPECT_THAT(ErrorOf({{File("hall.jpg"), "edges"}}, folder_ / "missing"),
              HasSubstr("missing: expected a folder that exists or a file .png"));
}

TEST_F(SeeOutputTest, TwoDrawingsOfOneNameAreRefused) {
  EXPECT_THAT(ErrorOf({{File("hall.jpg"), "edges"}, {File("hall.png"), "edges"}}),
              HasSubstr("hall-edges.png twice"));
}

TEST_F(SeeOutputTest, WhatIsThereStaysThereUnlessForced) {
  const std::string image = File("hall.jpg");
  File("hall-edges.png");
  EXPECT_THAT(ErrorOf({{image, "edges"}}), HasSubstr("hall-edges.png: is there already"));
  EXPECT_EQ(ErrorOf({{image, "edges"}}, "", true), "");
}

TEST_F(SeeOutputTest, AnImageThatIsReadIsNeverReplaced) {
  const std::string image = File("hall.png");
  fs::create_symlink(image, folder_ / "link.png");
  EXPECT_THAT(ErrorOf({{image, "edges"}}, image, true), HasSubstr("than one that is read"));
  EXPECT_THAT(ErrorOf({{image, "edges"}}, folder_ / "link.png", true), HasSubstr("than one that is read"));
}

TEST_F(SeeOutputTest, AFolderThatCannotBeWrittenIsNamedWithTheReason) {
  const std::string image = File("hall.jpg"), file = File("file");
  SeeOutput dut({{image, "edges"}}, {}, "/proc/none.png", false);
  dut.Add(image, "edges", "bytes");
  try {
    dut.Write();
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("/proc/none.png: cannot be written: "));
  }
}

TEST_F(SeeOutputTest, ADeviceIsWrittenToAndNotReplaced) {
  EXPECT_NO_THROW(RefuseToReplace("/dev/null", {}, false));
  WriteWhole("/dev/null", "bytes");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

}  // namespace
}  // namespace priamos::head
