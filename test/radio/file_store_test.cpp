#include "radio/file_store.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <vector>

#include "test/support/temporary_folder.hpp"

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
