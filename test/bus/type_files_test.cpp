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

}  // namespace
}  // namespace priamos::bus
