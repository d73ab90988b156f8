#include <gmock/gmock.h>

#include <set>

#include "test/support/project_files.hpp"

namespace priamos {
namespace {

namespace fs = std::filesystem;

TEST(TopLevel, HoldsTheAgreedFoldersAndNothingElse) {
  if (!IsGitClone(PRIAMOS_SOURCE_DIR)) GTEST_SKIP() << "no git clone: a file may be its user's own";
  const std::set<std::string> allowed{"CHANGELOG.md",
                                      "CMakeLists.txt",
                                      "CMakePresets.json",
                                      "CONTRIBUTING.md",
                                      "LICENSE",
                                      "README.md",
                                      "bus",
                                      "config",
                                      "lcmtypes",
                                      "logs",
                                      "modules",
                                      "scripts",
                                      "test"};
  for (const fs::path& file : ProjectFiles()) {
    const std::string name = *file.begin();
    EXPECT_TRUE(name.starts_with(".") || allowed.contains(name)) << file;
  }
}

}  // namespace
}  // namespace priamos
