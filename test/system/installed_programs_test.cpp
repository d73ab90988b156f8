// The installed programs, from any folder, on a machine that has neither the clone nor anything to develop
// with.

#include <gmock/gmock.h>

#include "test/system/installed_test.hpp"

namespace priamos {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class InstalledProgramsTest : public InstalledTest {};

TEST_F(InstalledProgramsTest, ARunInRealTimePassesTheDoor) {
  const auto answer = installed_.Run("priamos run --scenario door --seed 1", 120);
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  const std::string state = installed_.folder() / "home/.local/state/priamos/";
  EXPECT_THAT(answer.text, HasSubstr("logs and report: " + state));
  EXPECT_TRUE(fs::is_empty(installed_.folder() / "elsewhere")) << "nothing is left in the folder one is in";
}

/// Also after the whole folder was moved.
TEST_F(InstalledProgramsTest, ADeploymentGoesUpAndDown) {
  const auto answer = installed_.Run(R"(
    mv "$PREFIX" "$PREFIX, moved"; PATH="$PREFIX, moved/bin:$PATH"
    priamos up sim --detach && priamos status || exit 1
    cd / && priamos topic echo POSE --bus onboard --count 1 && timeout 20 priamos logs -n 1
    priamos down; priamos status && exit 1
    exit 0)",
                                     90);
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_THAT(answer.text, HasSubstr("everything is down"));
}

/// What the user keeps in ~/.config goes before what was installed, $PRIAMOS_DATA before both.
TEST_F(InstalledProgramsTest, TheUsersDeploymentGoesFirst) {
  const auto answer = installed_.Run(R"(
    mine=$HOME/.config/priamos/sim; mkdir -p "$mine" "$HOME/data/config/sim/scenarios"
    echo 'title = 1' > "$mine/deployment.toml"
    priamos up sim
    PRIAMOS_DATA=$HOME/data priamos lockstep
    priamos lockstep --deployment robto)",
                                     30);
  EXPECT_THAT(answer.text, HasSubstr("home/.config/priamos/sim/deployment.toml:1:title: expected a string"));
  EXPECT_THAT(answer.text, HasSubstr("home/data/config/sim, got \"door\""));
  EXPECT_THAT(answer.text, HasSubstr("\"robto\""));
  EXPECT_THAT(answer.text, HasSubstr((installed_.prefix() / "share/priamos/config").string()));
}

/// The lines of README.md that begin with `priamos`: endless ones are ended after a while.
std::string ReadmeCommands() {
  std::ifstream readme(PRIAMOS_SOURCE_DIR "/README.md");
  std::string commands;
  bool inside = false;
  for (std::string line; std::getline(readme, line);) {
    if (line.starts_with("```")) inside = line == "```sh";
    if (!inside || !line.starts_with("priamos ")) continue;
    commands += "say '" + line.substr(0, line.find(" #")) + "'\n";
  }
  return commands;
}

TEST_F(InstalledProgramsTest, EveryCommandOfTheReadmeWorksFromAnyFolder) {
  const std::string commands = ReadmeCommands();
  EXPECT_THAT(commands, HasSubstr("priamos topic list"));
  EXPECT_THAT(commands, HasSubstr("priamos replay verify"));
  const auto answer = installed_.Run(R"(
    say() {
      local limit=60; case "$1" in *--watch*|*" echo "*|*" record "*|*" serve "*) limit=6 ;; esac
      timeout --signal=INT --kill-after=5 $limit bash -c "$1" > said.txt 2>&1 < /dev/null; local code=$?
      [ $code = 0 ] || [ $code,$limit = 124,6 ] || { echo "FAILED with $code: $1"; head -n 5 said.txt; failed=1; }
      [ -s said.txt ] || { echo "SILENT: $1"; failed=1; }
    }
    failed=0
    priamos lockstep --logs there > /dev/null || exit 1
    cp there/seed-1/*.lcmlog .
    for side in onboard offboard; do
      priamos log play there/seed-1/$side.lcmlog --loop --bus $side > /dev/null 2>&1 < /dev/null & players="${players:-} $!"
    done
)" + commands + "kill $players; wait; exit $failed\n",
                                     200);
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
}

}  // namespace
}  // namespace priamos
