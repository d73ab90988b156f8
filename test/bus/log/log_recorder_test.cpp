#include "bus/log/log_recorder.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <set>

#include "bus/log/log_reader.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::bus {
namespace {

class RecorderTest : public testing::Test {
 protected:
  static constexpr std::size_t kMessageBytes = 1000;
  void Record(LogRecorder& dut, int events) {
    for (int i = 0; i < events; ++i) {
      now_ += std::chrono::milliseconds(10);
      dut.Add(now_, "POSE", std::vector<std::byte>(kMessageBytes));
      dut.Tick(now_);
    }
  }
  std::set<std::string> Files() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
      names.insert(entry.path().filename());
    return names;
  }
  static int EventsIn(const std::string& file) {
    LogReader reader(file);
    int events = 0;
    while (reader.Next()) ++events;
    EXPECT_EQ(reader.skipped_bytes(), 0u) << file;
    return events;
  }
  TemporaryFolder folder_;
  std::string file_ = folder_ / "run.lcmlog";
  Time now_ = FromUtime(1'000'000);
};

TEST_F(RecorderTest, WritesWhatItGets) {
  {
    LogRecorder dut(file_, {}, now_);
    Record(dut, 30);
  }
  EXPECT_EQ(EventsIn(file_), 30);
}

TEST_F(RecorderTest, WhatWasHeardIsInTheFileAfterOneTickPeriod) {
  LogRecorder dut(file_, {}, now_);
  Record(dut, 1);
  dut.Tick(now_ + std::chrono::milliseconds(250));
  EXPECT_EQ(EventsIn(file_), 1);
}

TEST_F(RecorderTest, ANameThatNoReaderTakesIsLostAndCounted) {
  {
    LogRecorder dut(file_, {}, now_);
    for (const std::string name : {"", "A\nB", "\xff"}) dut.Add(now_, name, {});
    EXPECT_EQ(dut.lost(), 3u);
    EXPECT_EQ(dut.unwritable(), 3u);
    Record(dut, 2);
  }
  EXPECT_EQ(EventsIn(file_), 2);
}

/// What one message in fragments may be, a reader takes; what is longer is lost and counted.
TEST_F(RecorderTest, AMessageThatNoReaderTakesIsLostAndCounted) {
  std::vector<std::byte> message(log_format::kMostDataBytes);
  {
    LogRecorder dut(file_, {}, now_);
    dut.Add(now_, "BIG", message);
    message.emplace_back();
    dut.Add(now_, "BIG", message);
    dut.Add(FromUtime(log_format::kLargestTime + 1), "LATE", {});
    EXPECT_EQ(dut.lost(), 2u);
    EXPECT_EQ(dut.unwritable(), 2u);
  }
  EXPECT_EQ(EventsIn(file_), 1);
}

TEST_F(RecorderTest, SplitsBySizeBetweenEvents) {
  {
    LogRecorder dut(file_, {.split_bytes = 10'000}, now_);
    Record(dut, 30);
    EXPECT_TRUE(dut.alarm().empty());
  }
  EXPECT_EQ(Files(), (std::set<std::string>{"run.lcmlog", "run.1.lcmlog", "run.2.lcmlog"}));
  EXPECT_EQ(EventsIn(file_), 10);
  EXPECT_EQ(EventsIn(folder_ / "run.1.lcmlog"), 10);
}

TEST_F(RecorderTest, FilesOfAnotherRecordingStay) {
  std::ofstream(folder_ / "run.1.lcmlog") << "theirs";
  {
    LogRecorder dut(file_, {.split_bytes = 10'000}, now_);
    Record(dut, 30);
  }
  EXPECT_EQ(Files(), (std::set<std::string>{"run.lcmlog", "run.1.lcmlog", "run.2.lcmlog", "run.3.lcmlog"}));
  EXPECT_EQ(std::filesystem::file_size(folder_ / "run.1.lcmlog"), 6u);
  EXPECT_EQ(EventsIn(folder_ / "run.2.lcmlog"), 10);
}

TEST_F(RecorderTest, SplitsByTime) {
  {
    LogRecorder dut(file_, {.split_time = std::chrono::milliseconds(105)}, now_);
    Record(dut, 25);
  }
  EXPECT_EQ(Files().size(), 3u);
}

TEST_F(RecorderTest, AFileInWhichNothingIsIsNotSplit) {
  {
    LogRecorder dut(file_, {.split_time = std::chrono::milliseconds(105)}, now_);
    now_ += std::chrono::seconds(1);
    Record(dut, 1);
  }
  EXPECT_EQ(Files(), std::set<std::string>{"run.lcmlog"});
  EXPECT_EQ(EventsIn(file_), 1);
}

TEST_F(RecorderTest, KeepsTheNewestFiles) {
  {
    LogRecorder dut(file_, {.split_bytes = 5'000, .keep_files = 2}, now_);
    Record(dut, 23);
  }
  EXPECT_EQ(Files(), (std::set<std::string>{"run.3.lcmlog", "run.4.lcmlog"}));
}

TEST_F(RecorderTest, TooLittleFreeSpaceIsAnAlarmAndTheFileStaysWhole) {
  LogRecorder dut(file_, {.keep_free_bytes = std::uint64_t{1} << 60}, now_);
  Record(dut, 100);  // one second
  EXPECT_NE(dut.alarm().find("are free"), std::string::npos) << dut.alarm();
  EXPECT_EQ(dut.recorded() + dut.lost(), 100u);
}

TEST_F(RecorderTest, TooLittleFreeSpaceDoesNotCostTheFileThatIsOpen) {
  LogRecorder dut(file_, {.keep_files = 2, .keep_free_bytes = std::uint64_t{1} << 60}, now_);
  Record(dut, 1);
  EXPECT_EQ(dut.recorded(), 1u);
  EXPECT_EQ(EventsIn(file_), 1);
}

TEST_F(RecorderTest, AFolderThatCannotBeWrittenIsASentenceAtTheStart) {
  EXPECT_THROW(LogRecorder(folder_ / "none/run.lcmlog", {}, now_), std::runtime_error);
}

/// A limit on the size of files fails writes in the middle, as a full disk does.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

TEST_F(RecorderTest, FullDiskLeavesOnlyWholeEventsAndIsReportedWithinASecond) {
  LogRecorder dut(file_, {}, now_);
  {
    const FullDisk full(20'500);
    Record(dut, 100);
    EXPECT_FALSE(dut.alarm().empty());
  }
  EXPECT_EQ(EventsIn(file_), 19);  // 1032 bytes each, flushed in batches of 20 or so
  EXPECT_EQ(dut.recorded() + dut.lost(), 100u);
}

TEST_F(RecorderTest, GoesOnInANewFileWhenThereIsRoomAgain) {
  LogRecorder dut(file_, {}, now_);
  {
    const FullDisk full(20'500);
    Record(dut, 40);
  }
  ASSERT_FALSE(dut.alarm().empty());
  Record(dut, 200);
  EXPECT_TRUE(dut.alarm().empty()) << dut.alarm();
  dut.Tick(now_ + std::chrono::seconds(1));
  EXPECT_EQ(dut.file().filename(), "run.1.lcmlog");
  EXPECT_EQ(EventsIn(dut.file()), static_cast<int>(dut.recorded()) - EventsIn(file_));
  EXPECT_GT(EventsIn(dut.file()), 80);
}

TEST_F(RecorderTest, NoNewFileIsBegunWhereItWouldEndAtOnce) {
  const auto logs = folder_ / "logs";
  std::filesystem::create_directory(logs);
  LogRecorder dut(logs / "run.lcmlog", {}, now_);
  {
    const FullDisk full(20'500);
    Record(dut, 40);
  }
  const std::string alarm = dut.alarm();
  EXPECT_NE(alarm.find("recording stopped"), std::string::npos) << alarm;
  EXPECT_NE(alarm.find("; goes on when 1 MB are free"), std::string::npos) << alarm;
  std::filesystem::remove_all(logs);
  std::filesystem::create_symlink("/proc", logs);  // where 0 bytes are free
  Record(dut, 200);
  EXPECT_EQ(dut.alarm(), alarm) << "it was tried";
}

}  // namespace
}  // namespace priamos::bus
