#include "radio/file_store.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <vector>

#include "test/support/temporary_folder.hpp"

namespace priamos::radio {
namespace {

struct FileStoreTest : testing::Test {
  TemporaryFolder folder;
  std::string path = (folder / "link.state").string();
  FileStore dut{path};
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
