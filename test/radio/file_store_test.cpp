#include "radio/file_store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <span>
#include <sstream>
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

/// Files of this folder cannot be written until it gets its name back.
struct LostFolder {
  explicit LostFolder(const std::filesystem::path& folder)
      : folder_(folder), away_(folder.string() + ".away") {
    std::filesystem::rename(folder_, away_);
  }
  void Return() { std::filesystem::rename(away_, folder_); }
  std::filesystem::path folder_, away_;
};

struct UnwritableStore : FileStoreTest {
  UnwritableStore() { std::filesystem::create_directory(folder / "states"); }
  /// Store in `file` alone, or in `file` on a RAM disk beside `disk`.
  std::unique_ptr<FileStore> Make(const std::string& disk) const {
    return disk.empty() ? std::make_unique<FileStore>(file) : std::make_unique<FileStore>(disk, file);
  }
  std::filesystem::path states = folder / "states";
  std::string file = (states / "link.state").string();
};

TEST_F(UnwritableStore, TheLinkGoesOnAndTheProblemIsNamedUntilItIsWritten) {
  for (const std::string& disk : {std::string(), path}) {
    auto dut = Make(disk);
    dut->Save(State(1));
    LostFolder lost(states);
    dut->Save(State(2));
    dut->StartSync();
    dut->AwaitSync();
    EXPECT_EQ(dut->problem(), file + ": No such file or directory");
    dut->Retry();
    EXPECT_NE(dut->problem(), "");
    lost.Return();
    dut->Save(State(3));
    EXPECT_NE(dut->problem(), "") << "written with Retry() alone, whose rate is bounded";
    dut->Retry();
    dut->AwaitSync();
    EXPECT_EQ(dut->problem(), "");
    dut.reset();
    EXPECT_EQ(Make(disk)->Load(), Latest(3));
  }
}

/// Else counters and numbers of events that were used since would be used again.
TEST_F(UnwritableStore, WhatWasNotWrittenBeforeTheEndMakesTheFileNotTheLatest) {
  for (const std::string& disk : {std::string(), path}) {
    auto dut = Make(disk);
    dut->Save(State(1));
    LostFolder lost(states);
    dut->Save(State(2));
    dut.reset();
    lost.Return();
    for (int start = 0; start < 2; ++start) EXPECT_EQ(Make(disk)->Load(), Older(1)) << start;
    dut = Make(disk);
    dut->Save(State(3));
    dut.reset();
    EXPECT_EQ(Make(disk)->Load(), Latest(3));
  }
}

TEST_F(UnwritableStore, AFolderThatIsNotThereIsNamedBeforeTheFirstSaveAndNothingIsLost) {
  FileStore(path, fast).Save(State(1));
  LostFolder lost(states);
  for (const auto& [disk, second] :
       {std::pair(file, fast), std::pair(fast, file), std::pair(file, std::string())}) {
    FileStore dut(disk, second);
    EXPECT_EQ(dut.problem(), file + ": No such file or directory");
    dut.Retry();
    dut.AwaitSync();
  }
  EXPECT_EQ(FileStore(path, fast).Load(), Latest(1));
}

TEST_F(UnwritableStore, TheDiskBehindARamDiskIsNamedAndTheRamDiskIsTheLatest) {
  const std::string nowhere = "/proc/no_such_folder/state";
  FileStore dut(nowhere, fast);
  dut.Save(State(1));
  dut.StartSync();
  dut.AwaitSync();
  EXPECT_EQ(dut.problem(), nowhere + ": No such file or directory");
  dut.Retry();
  dut.AwaitSync();
  EXPECT_NE(dut.problem(), "");
  EXPECT_EQ(FileStore(nowhere, fast).Load(), Latest(1));
}

TEST_F(FileStoreTest, AFileThatIsUsedSaysSoUnderAllItsNames) {
  const std::string link = (folder / "other-name").string();
  std::filesystem::create_symlink(path, link);
  {
    const FileStore first(path);
    EXPECT_EQ(first.in_use(), "");
    EXPECT_EQ(FileStore(link).in_use(), link);
    EXPECT_EQ(FileStore(folder / ("./" + std::string("link.state"))).in_use(), folder / "./link.state");
    EXPECT_EQ(FileStore(fast, path).in_use(), path);
    EXPECT_EQ(FileStore(fast).in_use(), "");
  }
  EXPECT_EQ(FileStore(path).in_use(), "");
}

TEST_F(FileStoreTest, AStateIsToldFromOtherFilesAlsoWhenItIsDamaged) {
  FileStore(path, "", BootId() + ":onboard:0").Save(std::as_bytes(std::span("PLK3 and so on")));
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  const std::string whole = text.str();
  EXPECT_TRUE(IsStateFile(whole));
  EXPECT_TRUE(IsStateFile(whole.substr(0, 40)));
  EXPECT_TRUE(IsStateFile("x" + whole.substr(1)));
  EXPECT_TRUE(IsStateFile("\nPLK4"));
  EXPECT_TRUE(IsStateFile(""));
  EXPECT_TRUE(IsStateFile(std::string(20, '\0')));
  EXPECT_FALSE(IsStateFile("my important notes\n"));
  EXPECT_FALSE(IsStateFile("0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef\n")) << "a key";
  EXPECT_FALSE(IsStateFile("link = \"link.toml\"\nstate_file = \"PLK\"\n"));
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
