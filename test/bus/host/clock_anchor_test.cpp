#include "bus/host/clock_anchor.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <thread>

#include "test/support/temporary_folder.hpp"

namespace priamos::bus {
namespace {

using std::chrono::hours;
using std::chrono::seconds;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr Duration kNow = std::chrono::seconds(1'790'000'000);
constexpr const char* kName = "clock-6f1c";

class ClockAnchorTest : public testing::Test {
 protected:
  ClockAnchor Agree(Duration proposal) const {
    return AgreeOnAnchor({{Place(), false, false}}, kName, proposal);
  }
  std::filesystem::path Place() const { return folder_ / "runtime"; }
  std::filesystem::path File() const { return Place() / kName; }
  /// Makes the file what somebody else might have left there.
  void Leave(const std::string& text, mode_t mode = 0600) const {
    std::filesystem::create_directory(Place());
    std::filesystem::permissions(Place(), std::filesystem::perms::owner_all);
    std::filesystem::remove(File());
    std::ofstream(File()) << text;
    chmod(File().c_str(), mode);
  }
  void ExpectRefused(const std::string& reason) const {
    const ClockAnchor anchor = Agree(kNow);
    EXPECT_EQ(anchor.unix_minus_boot, kNow) << "its own";
    EXPECT_TRUE(anchor.file.empty());
    EXPECT_THAT(anchor.problem, HasSubstr(reason));
    EXPECT_EQ(anchor.problem.find('\n'), std::string::npos);
  }
  TemporaryFolder folder_;
};

TEST_F(ClockAnchorTest, AStepOfAnHourBetweenTwoStartsLeavesStampsAligned) {
  EXPECT_EQ(Agree(kNow).unix_minus_boot, kNow) << "the first one decides";
  for (const Duration step :
       {Duration(hours(1)), Duration(hours(-1)), Duration(1), Duration(hours(24 * 365 * 20))})
    EXPECT_EQ(Agree(kNow + step).unix_minus_boot, kNow);
  EXPECT_EQ(Agree(kNow + hours(1)).file, File());
  EXPECT_THAT(Agree(kNow).problem, IsEmpty());
}

TEST_F(ClockAnchorTest, EveryBootHasItsOwn) {
  Agree(kNow);
  const std::vector<AnchorFolder> folders{{Place(), false, false}};
  EXPECT_EQ(AgreeOnAnchor(folders, "clock-7a2d", kNow + hours(1)).unix_minus_boot, kNow + hours(1));
}

TEST_F(ClockAnchorTest, OfManyThatStartAtOnceOneIsFirst) {
  std::vector<Duration> agreed(32);
  std::vector<std::thread> threads;
  for (int i = 0; i < 32; ++i)
    threads.emplace_back(
        [&, i] { agreed[static_cast<std::size_t>(i)] = Agree(kNow + seconds(i)).unix_minus_boot; });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(std::set<Duration>(agreed.begin(), agreed.end()).size(), 1U);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(Place()), {}), 1) << "no drafts are left";
}

TEST_F(ClockAnchorTest, WhatIsNoAnchorIsNotUsed) {
  for (const char* text :
       {"", "\n", "priamos clock anchor 1\n", "priamos clock anchor 1\n1790000000000000",
        "priamos clock anchor 2\n1\n", "priamos clock anchor 1\n-5\n",
        "priamos clock anchor 1\n9223372036854775807\n", "priamos clock anchor 1\n99999999999999999999999\n",
        "priamos clock anchor 1\n1 \n", "priamos clock anchor 1\n1\n2\n", "priamos clock anchor 1\n0x10\n"}) {
    Leave(text);
    ExpectRefused("expected an anchor of the clock");
  }
  Leave("priamos clock anchor 1\n" + std::string(1'000'000, '1') + "\n");
  ExpectRefused("at most 128 bytes");
  Leave("priamos clock anchor 1\n1790000000000000\n");
  EXPECT_EQ(Agree(kNow + hours(1)).unix_minus_boot, kNow);
}

TEST_F(ClockAnchorTest, WhatOthersMayWriteIsNotUsed) {
  const std::string good = "priamos clock anchor 1\n1790000000000000\n";
  Leave(good, 0666);
  ExpectRefused("nobody else may write");
  Leave(good, 0620);
  ExpectRefused("nobody else may write");
  Leave(good, 0644);
  chmod(Place().c_str(), 0777);
  ExpectRefused("only its owner");
}

TEST_F(ClockAnchorTest, LinksPipesAndFoldersAreNotUsed) {
  Leave("");
  std::ofstream(folder_ / "elsewhere") << "priamos clock anchor 1\n5\n";
  std::filesystem::remove(File());
  std::filesystem::create_symlink(folder_ / "elsewhere", File());
  ExpectRefused("expected a file that can be read");
  std::filesystem::remove(File());
  ASSERT_EQ(mkfifo(File().c_str(), 0600), 0);
  ExpectRefused("nobody else may write");
  std::filesystem::remove(File());
  std::filesystem::create_directory(File());
  ExpectRefused("nobody else may write");
}

TEST_F(ClockAnchorTest, AFolderThatIsALinkOrAFileIsNotUsed) {
  std::filesystem::create_directory(folder_ / "elsewhere");
  std::filesystem::create_symlink(folder_ / "elsewhere", Place());
  ExpectRefused("expected a folder");
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "elsewhere"));
  std::filesystem::remove(Place());
  std::ofstream(Place()) << "";
  ExpectRefused("expected a folder");
}

TEST_F(ClockAnchorTest, AFolderOfAnotherUserIsUsedOnlyWhereRootAloneCanMakeOne) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give a folder away";
  Leave("priamos clock anchor 1\n1790000000000000\n", 0644);
  ASSERT_EQ(chown(Place().c_str(), 12345, 12345), 0);
  ASSERT_EQ(chown(File().c_str(), 12345, 12345), 0);
  ExpectRefused("only its owner");
  EXPECT_EQ(AgreeOnAnchor({{Place(), true, true}}, kName, kNow + hours(1)).unix_minus_boot, kNow);
  ASSERT_EQ(chown(File().c_str(), 54321, 54321), 0);
  EXPECT_THAT(AgreeOnAnchor({{Place(), true, true}}, kName, kNow).problem,
              HasSubstr("nobody else may write"));
}

TEST_F(ClockAnchorTest, WhereTheFirstFolderCannotBeUsedTheSecondIs) {
  const std::vector<AnchorFolder> folders{{folder_ / "no" / "such" / "place", true, true},
                                          {Place(), false, false}};
  const ClockAnchor anchor = AgreeOnAnchor(folders, kName, kNow);
  EXPECT_EQ(anchor.file, File());
  EXPECT_EQ(AgreeOnAnchor(folders, kName, kNow + hours(1)).unix_minus_boot, kNow);
}

TEST_F(ClockAnchorTest, WithoutABootThereIsNothingToAgreeOn) {
  EXPECT_THAT(AgreeOnAnchor({{Place(), false, false}}, "", kNow).problem, HasSubstr("which boot"));
  EXPECT_FALSE(std::filesystem::exists(Place()));
}

TEST(AnchorFolders, TheChosenOneIsTheOnlyOne) {
  setenv("PRIAMOS_RUNTIME", "/some/place", 1);
  ASSERT_EQ(AnchorFolders().size(), 1U);
  EXPECT_EQ(AnchorFolders()[0].path, "/some/place");
  unsetenv("PRIAMOS_RUNTIME");
  EXPECT_EQ(AnchorFolders().size(), 2U);
}

}  // namespace
}  // namespace priamos::bus
