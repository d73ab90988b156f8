#include <gmock/gmock.h>

#include <filesystem>
#include <set>

namespace priamos {
namespace {

namespace fs = std::filesystem;

TEST(TopLevel, HoldsTheAgreedFoldersAndNothingElse) {
  const std::set<std::string> allowed{
      "CMakeLists.txt", "CMakePresets.json", "LICENSE", "README.md", "bus", "config", "lcmtypes",
      "logs",           "modules",           "scripts", "test"};
  for (const auto& entry : fs::directory_iterator(PRIAMOS_SOURCE_DIR)) {
    const std::string name = entry.path().filename();
    if (name.starts_with(".") || name.starts_with("build")) continue;
    EXPECT_TRUE(allowed.contains(name)) << name;
  }
}

}  // namespace
}  // namespace priamos
