#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "test/support/shell.hpp"
#include "test/support/temporary_folder.hpp"

// What the options of CMake leave out is neither looked for nor built, and what they leave is whole.

namespace priamos {
namespace {

std::string Content(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

struct Option {
  const char* name;
  std::vector<std::string> absent_libraries;  ///< as CMake's cache would name them, in small letters
  std::vector<std::string> absent_folders;
  std::vector<std::string> made;
  const char* target;  ///< what a user builds
};
void PrintTo(const Option& option, std::ostream* out) {
  *out << option.name;
}

class BuildOption : public ::testing::TestWithParam<Option> {};

TEST_P(BuildOption, LeavesOutWhatItSaysAndTheRestIsWhole) {
  const TemporaryFolder build;
  const std::string folder = "'" + build.path().string() + "'";
  const auto configured =
      RunShell("cmake -G Ninja -S '" PRIAMOS_SOURCE_DIR "' -B " + folder + " -D" + GetParam().name + "=OFF");
  ASSERT_EQ(configured.exit_code, 0) << configured.text;
  std::string cache = Content(build / "CMakeCache.txt");
  std::transform(cache.begin(), cache.end(), cache.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const std::string& library : GetParam().absent_libraries)
    EXPECT_EQ(cache.find(library), std::string::npos) << library;
  const std::string rules = Content(build / "build.ninja");
  for (const std::string& left_out : GetParam().absent_folders)
    EXPECT_EQ(rules.find(PRIAMOS_SOURCE_DIR "/" + left_out), std::string::npos) << left_out;
  for (const char* ours : {" -lworld", " -lcli", " -lhead", " -lrobot", " -lbus", " -lcommon"})
    EXPECT_EQ(rules.find(ours), std::string::npos) << ours << ": a library of ours that is not built";
  for (const std::string& made : GetParam().made)
    EXPECT_EQ(RunShell("ninja -C " + folder + " -t query " + made).exit_code, 0) << made;
  const auto planned = RunShell("ninja -C " + folder + " -n " + GetParam().target);
  EXPECT_EQ(planned.exit_code, 0) << planned.text;
}

INSTANTIATE_TEST_SUITE_P(
    All, BuildOption,
    ::testing::Values(Option{"PRIAMOS_SIMULATION",
                             {"mrpt", "opengl"},
                             {"modules/world/", "modules/cli/", "test/"},
                             {"bin/priamos-robot", "bin/priamos-head", "bin/priamos-planner",
                              "bin/priamos-teleop", "bin/priamos-console", "bin/priamos-radio"},
                             "product"},
                      Option{"PRIAMOS_ROBOT",
                             {"mrpt", "opengl", "opencv", "ceres", "assimp"},
                             {"modules/robot/", "modules/head/", "modules/world/", "modules/cli/", "test/"},
                             {"bus/libbus.a", "bus/log/libbus_log.a", "bus/schema/libbus_schema.a",
                              "bus/radio/libbus_radio.a"},
                             "all"}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace priamos
