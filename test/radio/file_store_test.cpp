#include "radio/file_store.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <vector>

namespace priamos::radio {
namespace {

struct FileStoreTest : testing::Test {
  std::string path = (std::filesystem::path(testing::TempDir()) / "file_store_test.state").string();
  FileStore dut{path};
  void SetUp() override { std::filesystem::remove(path); }
  void TearDown() override { std::filesystem::remove(path); }
};

TEST_F(FileStoreTest, NothingBeforeTheFirstSave) {
  EXPECT_FALSE(dut.Load());
}

TEST_F(FileStoreTest, LastSavedStateIsLoaded) {
  for (const bool durable : {true, false}) {
    const std::vector state{std::byte{0}, std::byte{durable}, std::byte{255}};
    dut.Save(state, durable);
    EXPECT_EQ(FileStore(path).Load(), state);
  }
}

TEST(FileStore, AnUnwritablePlaceIsReported) {
  FileStore dut("/proc/no_such_folder/state");
  EXPECT_THROW(dut.Save({}, true), std::runtime_error);
}

}  // namespace
}  // namespace priamos::radio
