#include "radio/file_store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <vector>

#include "test/support/temporary_folder.hpp"
#include "test/support/thrown_reason.hpp"

namespace priamos::radio {
namespace {

std::vector<std::byte> State(int number) {
  return {std::byte{0}, static_cast<std::byte>(number), std::byte{255}, std::byte{'\n'}};
}
bus::radio::SavedState Latest(int number) {
  return {.bytes = State(number), .latest = true};
}
bus::radio::SavedState Older(int number) {
  return {.bytes = State(number), .latest = false};
}

struct FileStoreTest : testing::Test {
  TemporaryFolder folder;
  std::string path = (folder / "link.state").string();
  std::string fast = (folder / "fast.state").string();
};

TEST_F(FileStoreTest, NothingBeforeTheFirstSave) {
  EXPECT_FALSE(FileStore(path).Load());
  EXPECT_FALSE(FileStore(path, fast).Load());
}

/// Its reader would wait for a writer, or for an end; and saving would put a file in its place.
TEST_F(FileStoreTest, WhatIsNoFileIsRefusedAtOnce) {
  const auto why = [&](const std::string& file, const std::string& second) {
    return support::ThrownReason([&] { FileStore(file, second).Load(); });
  };
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  EXPECT_EQ(why(path, ""),
            path + ": expected the radio's state, a file of at most 4194304 bytes, got a pipe");
  EXPECT_THAT(why(fast, path), testing::EndsWith("got a pipe"));
  EXPECT_THAT(why(folder.path(), ""), testing::EndsWith("got a folder"));
  EXPECT_THAT(why("/dev/zero", ""), testing::EndsWith("got a device"));
  std::filesystem::remove(path);
  std::ofstream(path).close();
  std::filesystem::resize_file(path, 4 << 20);
  EXPECT_EQ(why(path, ""), "");
  std::filesystem::resize_file(path, (4 << 20) + 1);
  EXPECT_THAT(why(path, ""), testing::HasSubstr("got a longer one"));
}

TEST_F(FileStoreTest, LastSavedStateIsLoadedSyncedOrNot) {
  for (const std::string& second : {std::string(), fast}) {
    std::filesystem::remove(path);
    FileStore dut(path, second);
    for (int i = 0; i < 4; ++i) {
      dut.Save(State(i));
      if (i > 0) dut.StartSync();
      if (i > 1) dut.AwaitSync();
      EXPECT_EQ(FileStore(path, second).Load(), Latest(i));
    }
  }
}

TEST_F(FileStoreTest, ALossOfPowerLeavesTheSyncedState) {
  FileStore dut(path, fast);
  dut.Save(State(1));
  dut.StartSync();
  dut.AwaitSync();
  dut.Save(State(2));
  std::filesystem::remove(fast);
  EXPECT_EQ(FileStore(path, fast).Load(), Older(1));
}

TEST_F(FileStoreTest, WhatAnotherBootLeftOnTheDiskNeedNotBeTheLatest) {
  FileStore(path, "", "boot 1").Save(State(1));
  EXPECT_EQ(FileStore(path, "", "boot 1").Load(), Latest(1));
  EXPECT_EQ(FileStore(path, "", "boot 2").Load(), Older(1));
  EXPECT_EQ(FileStore(path, "", "").Load(), Older(1)) << "a machine that names no boot";
}

TEST_F(FileStoreTest, ASyncThatNobodyWaitedForIsFinishedBeforeTheEnd) {
  {
    FileStore dut(path, fast);
    dut.Save(State(1));
    dut.StartSync();
  }
  EXPECT_EQ(FileStore(path).Load(), Older(1));
}

TEST_F(FileStoreTest, WithoutARamDiskASyncNeverBringsBackAnOlderState) {
  FileStore dut(path);
  for (int i = 0; i < 200; ++i) {
    dut.Save(State(i));
    if (i % 2 == 0) dut.StartSync();
  }
  dut.AwaitSync();
  EXPECT_EQ(FileStore(path).Load(), Latest(199));
}

/// Somebody who keeps a copy and puts it back: by copying, or by renaming the kept one.
TEST_F(FileStoreTest, AnOlderStateThatIsPutBackIsNotTheLatest) {
  for (const bool by_name : {false, true}) {
    for (const bool ram_disk : {false, true}) {
      const std::string& file = ram_disk ? fast : path;
      const std::string& second = ram_disk ? fast : "";
      const std::string kept = (folder / "kept").string();
      std::filesystem::remove(path);
      std::filesystem::remove(fast);
      FileStore dut(path, second);
      dut.Save(State(1));
      if (by_name) std::filesystem::create_hard_link(file, kept);
      if (!by_name) std::filesystem::copy_file(file, kept);
      dut.Save(State(2));
      EXPECT_EQ(FileStore(path, second).Load(), Latest(2));
      std::this_thread::sleep_for(std::chrono::milliseconds(80));
      std::filesystem::rename(kept, file);
      EXPECT_EQ(FileStore(path, second, BootId(), std::chrono::milliseconds(50)).Load(), Older(1));
    }
  }
}

/// The file in a folder that was copied at once after a write keeps its time of change when the folder is
/// renamed.
TEST_F(FileStoreTest, AFolderThatIsPutBackHasNotTheLatestState) {
  const std::filesystem::path states = folder / "states", kept = folder / "kept-states";
  std::filesystem::create_directory(states);
  FileStore dut((states / "link.state").string());
  dut.Save(State(1));
  std::filesystem::copy(states, kept, std::filesystem::copy_options::recursive);
  dut.Save(State(2));
  EXPECT_EQ(FileStore((states / "link.state").string()).Load(), Latest(2));
  std::filesystem::remove_all(states);
  std::filesystem::rename(kept, states);
  EXPECT_EQ(FileStore((states / "link.state").string()).Load(), Older(1));
}

TEST_F(FileStoreTest, AStateWithoutTheTimeOfItsWritingIsNotTheLatest) {
  std::ofstream(path) << BootId() << "\nstate";
  EXPECT_FALSE(FileStore(path).Load()->latest);
}

TEST_F(FileStoreTest, AnUnwritablePlaceIsReported) {
  EXPECT_THROW(FileStore("/proc/no_such_folder/state").Save(State(1)), std::runtime_error);
  FileStore dut("/proc/no_such_folder/state", fast);
  dut.Save(State(1));
  dut.StartSync();
  EXPECT_THROW(dut.AwaitSync(), std::runtime_error);
}

TEST_F(FileStoreTest, AFailureThatNobodyWaitedForIsReportedWithTheNextCall) {
  FileStore dut("/proc/no_such_folder/state", fast);
  dut.Save(State(1));
  dut.StartSync();
  EXPECT_THROW(
      {
        for (int i = 0; i < 1000; ++i) {
          dut.Save(State(i));
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
      },
      std::runtime_error);
}

TEST_F(FileStoreTest, WithoutTheRamDiskOfBeforeTheDiskIsNotTheLatest) {
  {
    FileStore dut(path, fast);
    dut.Save(State(1));
    dut.StartSync();
    dut.AwaitSync();
    dut.Save(State(2));
  }
  EXPECT_EQ(FileStore(path).Load(), Older(1));
}

TEST_F(FileStoreTest, ARamDiskOfBeforeTheDiskWasAloneIsNotTheLatest) {
  {
    FileStore dut(path, fast);
    dut.Save(State(1));
  }
  {
    FileStore dut(path);
    dut.Save(State(2));
  }
  EXPECT_FALSE(FileStore(path, fast).Load()->latest);
}

}  // namespace
}  // namespace priamos::radio
