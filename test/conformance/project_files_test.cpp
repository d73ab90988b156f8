#include "test/support/project_files.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "test/support/temporary_folder.hpp"

namespace priamos {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A clone with two files of the project and one of its user, in a folder with a blank.
class ProjectFilesTest : public ::testing::Test {
 protected:
  ProjectFilesTest() {
    for (const char* file : {"README.md", "bus/bus.hpp", "bus/notes.hpp"}) Write(file);
  }
  void Write(const std::string& file) {
    std::filesystem::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << "text\n";
  }
  void Track() {
    const auto answer =
        RunShell("cd '" + root_.string() + "' && git init -q && git add README.md bus/bus.hpp");
    ASSERT_EQ(answer.exit_code, 0) << answer.text;
  }
  const TemporaryFolder folder_;
  const std::filesystem::path root_ = folder_ / "a clone";
};

TEST_F(ProjectFilesTest, AFileOfTheUserIsNoneOfTheProject) {
  Track();
  EXPECT_THAT(ProjectFiles("", root_), ElementsAre("README.md", "bus/bus.hpp"));
  EXPECT_THAT(ProjectFiles("bus", root_), ElementsAre("bus/bus.hpp"));
  EXPECT_THAT(ProjectFiles("bu", root_), IsEmpty());
}

TEST_F(ProjectFilesTest, AFileThatWasDeletedIsGone) {
  Track();
  std::filesystem::remove(root_ / "README.md");
  EXPECT_THAT(ProjectFiles("", root_), ElementsAre("bus/bus.hpp"));
}

TEST_F(ProjectFilesTest, InAnExportedTreeEverythingIsTheProjects) {
  for (const char* file : {"build-mine/x.hpp", ".editor/x.hpp"}) Write(file);
  EXPECT_FALSE(IsGitClone(root_));
  EXPECT_THAT(ProjectFiles("", root_), ElementsAre("README.md", "bus/bus.hpp", "bus/notes.hpp"));
}

}  // namespace
}  // namespace priamos
