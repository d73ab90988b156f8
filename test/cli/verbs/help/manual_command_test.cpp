#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "test/cli/priamos_answer.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

PriamosAnswer Write(const fs::path& folder) {
  return Priamos({"manual", folder, "--date", "2026-11-22", "--release", "priamos 9.9"});
}

TEST(ManualCommand, WritesAPagePerVerbAndPerFileIntoItsSection) {
  TemporaryFolder folder;
  EXPECT_EQ(Write(folder / "man").exit_code, 0);
  for (const char* page : {"man1/priamos.1", "man1/priamos-log.1", "man1/priamos-robot.1",
                           "man5/priamos-deployment.5", "man5/priamos-link.5"})
    EXPECT_THAT(FileContent(folder / "man" / page), HasSubstr("\"2026-11-22\" \"priamos 9.9\"")) << page;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "man")) {
    if (!entry.is_regular_file()) continue;
    const std::string section = entry.path().parent_path().string();
    EXPECT_EQ(entry.path().extension().string().back(), section.back()) << entry.path();
  }
}

TEST(ManualCommand, ThePageOfTheOtherProgramIsThatOfPriamos) {
  TemporaryFolder folder;
  EXPECT_EQ(Write(folder.path()).exit_code, 0);
  EXPECT_EQ(Write(folder.path()).exit_code, 0) << "a second time replaces the first";
  EXPECT_EQ(fs::read_symlink(folder / "man1/priamos-verbs.1"), "priamos.1");
}

TEST(ManualCommand, AFolderThatCannotBeMadeIsOneSentence) {
  TemporaryFolder folder;
  std::ofstream(folder / "file").close();
  const auto answer = Write(folder / "file");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_EQ(LinesOf(answer.err).size(), 1u);
  EXPECT_THAT(answer.err, AllOf(StartsWith("priamos manual: "), HasSubstr("/file")));
}

TEST(ManualCommand, DateAndReleaseAreWanted) {
  const auto answer = Priamos({"manual", "somewhere"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("--date (YYYY-MM-DD)"));
  EXPECT_FALSE(fs::exists("somewhere"));
}

TEST(ManualCommand, ItsVerbIsHiddenFromPeople) {
  EXPECT_EQ(Priamos({"--help"}).out.find("manual"), std::string::npos);
}

}  // namespace
}  // namespace priamos::cli
