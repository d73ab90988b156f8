#include "bus/type_files.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "test/support/temporary_folder.hpp"

namespace priamos::bus {
namespace {

using ::testing::HasSubstr;

TEST(TypeFiles, AreFoundInFoldersBelowInTheOrderOfTheirPaths) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "a");
  std::ofstream(folder.path() / "b.lcm") << "struct b {\n}\n";
  std::ofstream(folder.path() / "a" / "c.lcm") << "struct c {\n}\n";
  std::ofstream(folder.path() / "README.md") << "no type\n";
  const auto dut = ReadTypeFiles(folder.path());
  ASSERT_EQ(dut.size(), 2u);
  EXPECT_EQ(dut[0].file, (folder.path() / "a" / "c.lcm").string());
  EXPECT_EQ(dut[0].text, "struct c {\n}\n");
  EXPECT_EQ(dut[1].file, (folder.path() / "b.lcm").string());
}

TEST(TypeFiles, AFolderThatIsNotThereOrHoldsNoneIsRefusedByName) {
  const auto refusal = [](const std::filesystem::path& folder) -> std::string {
    try {
      ReadTypeFiles(folder);
    } catch (const SchemaError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refusal("/nonexistent"), HasSubstr("/nonexistent: cannot be read"));
  const TemporaryFolder empty;
  EXPECT_EQ(refusal(empty.path()), empty.path().string() + ": there is no .lcm file in it");
}

TEST(TypeFiles, OfSeveralFoldersEachFileIsReadOnce) {
  const TemporaryFolder folder, other;
  std::filesystem::create_directories(folder.path() / "a" / "b");
  std::ofstream(folder.path() / "a" / "b" / "c.lcm") << "struct c {\n}\n";
  std::ofstream(other.path() / "d.lcm") << "struct d {\n}\n";
  std::filesystem::create_directory_symlink(folder.path(), folder.path() / "a" / "round");
  std::vector<std::string> problems;
  const auto dut =
      ReadTypeFolders({folder.path(), other.path(), folder.path() / "a", folder.path() / "a/../a"}, problems);
  ASSERT_EQ(dut.size(), 2u);
  EXPECT_EQ(dut[1].file, (other.path() / "d.lcm").string());
  EXPECT_TRUE(problems.empty());
}

TEST(TypeFiles, OneThatCannotBeReadDoesNotHinderTheOthers) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "a.lcm") << "struct a {\n}\n";
  std::filesystem::create_symlink("nowhere", folder.path() / "b.lcm");
  std::filesystem::create_symlink("c.lcm", folder.path() / "c.lcm");
  std::filesystem::create_directory(folder.path() / "d.lcm");
  std::vector<std::string> problems;
  EXPECT_EQ(ReadTypeFolders({folder.path()}, problems).size(), 1u);
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[0], (folder.path() / "b.lcm").string() + ": cannot be read");
}

}  // namespace
}  // namespace priamos::bus
