#include "head/files/calibration_journal.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <sstream>

namespace priamos::head {
namespace {

class CalibrationJournalTest : public testing::Test {
 protected:
  CalibrationJournalTest() { std::filesystem::create_directories(folder_); }
  ~CalibrationJournalTest() override { std::filesystem::remove_all(folder_); }

  static CalibrationExposure Exposure(int k) {
    return {{0.1 * k, -0.05, {-0.02, 0.02}, {650, 651}, {1600, 1601}},
            {{{0, 100.123456789012345 + k, 200, 0.01}, {15, 300, 400, 0.02}}, {}, {{3, 1, 2, 0.03}}}};
  }
  CalibrationJournal Journal(const std::string& fingerprint = "abc") const {
    return CalibrationJournal(path_, fingerprint, 16);
  }
  std::string Text() const {
    std::ifstream file(path_);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("priamos-journal-" + std::to_string(getpid()));
  const std::string path_ = folder_ / "kastor.yaml.journal";
};

TEST_F(CalibrationJournalTest, GoesOnWhereItStopped) {
  {
    auto first = Journal();
    EXPECT_TRUE(first.Resume().empty());
    first.Add(Exposure(0));
    first.Add(Exposure(1));
  }
  auto dut = Journal();
  const auto done = dut.Resume();
  ASSERT_EQ(done.size(), 2u);
  EXPECT_EQ(done[1].cameras[0][0].u_px, Exposure(1).cameras[0][0].u_px);
  EXPECT_EQ(done[1].cameras[0][1].disc, 15);
  EXPECT_TRUE(done[1].cameras[1].empty());
  EXPECT_TRUE(IsSameSetting(done[1].setting, Exposure(1).setting, 1e-15));
  dut.Add(Exposure(2));
  EXPECT_EQ(Journal().Resume().size(), 3u);
}

TEST_F(CalibrationJournalTest, ALineThatWasCutOffIsMeasuredAgain) {
  {
    auto first = Journal();
    first.Resume();
    for (int k = 0; k < 3; ++k) first.Add(Exposure(k));
  }
  const std::string text = Text();
  for (const std::size_t missing : {1, 5, 60}) {
    std::ofstream(path_, std::ios::trunc) << text.substr(0, text.size() - 1 - missing);
    EXPECT_EQ(Journal().Resume().size(), 2u) << missing;
  }
}

TEST_F(CalibrationJournalTest, AnotherPlanBeginsAnew) {
  {
    auto first = Journal();
    first.Resume();
    first.Add(Exposure(0));
  }
  EXPECT_TRUE(Journal("other").Resume().empty());
}

TEST_F(CalibrationJournalTest, ForeignFilesBeginAnew) {
  for (const char* text : {"", "{", "hello\nworld\n", "[1,2]\n", "{\"kind\":3}\n"}) {
    std::ofstream(path_, std::ios::trunc) << text;
    EXPECT_TRUE(Journal().Resume().empty()) << text;
  }
}

TEST_F(CalibrationJournalTest, DiscsThatTheObjectDoesNotHaveAreNotBelieved) {
  {
    auto first = Journal();
    first.Resume();
    first.Add(Exposure(0));
  }
  EXPECT_TRUE(CalibrationJournal(path_, "abc", 10).Resume().empty());
}

TEST_F(CalibrationJournalTest, IsGoneWhenTheTableIsThere) {
  auto dut = Journal();
  dut.Resume();
  dut.Remove();
  EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST(Fingerprint, TellsTextsApart) {
  EXPECT_EQ(Fingerprint(""), "cbf29ce484222325");
  EXPECT_EQ(Fingerprint("a"), "af63dc4c8601ec8c");  // published test vector of FNV-1a
  EXPECT_NE(Fingerprint("pan = 1"), Fingerprint("pan = 2"));
}

}  // namespace
}  // namespace priamos::head
