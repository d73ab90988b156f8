// What a person gets who mistypes: one sentence with the wrong word and the nearest right one, exit code 2,
// at once.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "test/support/temporary_folder.hpp"
#include "test/system/private_network.hpp"

namespace priamos {
namespace {

using testing::HasSubstr;

struct WrongLine {
  std::string line;
  std::string wrong;  ///< as it has to be quoted back
  std::string right;  ///< what it has to be answered with
};

const std::vector<WrongLine> kLines{
    // verbs
    {"priamos stats", "unknown verb \"stats\"", "\"status\""},
    {"priamos tpoic", "unknown verb \"tpoic\"", "\"topic\""},
    {"priamos topic lst", "unknown verb \"lst\"", "\"list\""},
    {"priamos topic ehco POSE", "unknown verb \"ehco\"", "\"echo\""},
    {"priamos estpo", "unknown verb \"estpo\"", "\"estop\""},
    {"priamos echo POSE", "unknown verb \"echo\"", "\"topic echo\""},
    {"priamos wehre", "unknown verb \"wehre\"", "\"where\""},
    {"priamos mission dor laboratory", "unknown verb \"dor\"", "\"door\""},
    {"priamos mission", "got none",
     "abort, cancel, corridor, door, elevator, explore, goto, list, locate, patrol, pause, resume, run, "
     "status"},
    {"priamos log inof x.lcmlog", "unknown verb \"inof\"", "\"info\""},
    {"priamos link bugdet", "unknown verb \"bugdet\"", "\"budget\""},
    {"priamos completion bahs", "unknown verb \"bahs\"", "\"bash\""},
    {"priamos help tpoic", "unknown verb \"tpoic\"", "\"topic\""},
    {"priamos status now", "got \"now\"", "no argument"},
    // options
    {"priamos topic list --jsno", "unknown option \"--jsno\"", "\"--json\""},
    {"priamos run --sceanrio door", "unknown option \"--sceanrio\"", "\"--scenario\""},
    {"priamos estop --waite 1", "unknown option \"--waite\"", "\"--wait\""},
    {"priamos logs --lgos x", "unknown option \"--lgos\"", "\"--logs\""},
    {"priamos --json topic list", "unknown option \"--json\"", "priamos topic list --json"},
    {"priamos-robot --conifg x.toml", "unknown option \"--conifg\"", "\"--config\""},
    {"priamos-teleop --kyboard", "unknown option \"--kyboard\"", "\"--keyboard\""},
    // values
    {"priamos run --seed -1", "--seed: expected a whole number", "got \"-1\""},
    {"priamos-world --seed -1", "--seed: expected a whole number", "got \"-1\""},
    {"priamos lockstep --runs many", "--runs: expected a whole number", "got \"many\""},
    {"priamos estop --wait nan", "--wait: expected a number, 0.1 to 600", "got \"nan\""},
    {"priamos topic hz", "expected channel", "got none"},
    {"priamos up $SOURCE/config/sim --group onbord", "got \"onbord\"", "\"onboard\""},
    {"priamos log export $SOURCE/logs/recorded/door-onboard.lcmlog cvs", "got \"cvs\"", "\"csv\""},
    {"priamos replay verify $SOURCE/logs/recorded/door-onboard.lcmlog --module robto", "got \"robto\"",
     "\"robot\""},
    {"priamos topic echo ''", "expected channel (LCM channel), got \"\"", "priamos topic echo --help"},
    {"priamos see ''", "expected image", "got \"\""},
    {"priamos see /nonexistent.png", "/nonexistent.png: expected an image", "got none"},
    {"priamos-robot --config \"${NOT_SET:-}\"", "--config: expected a value", "got \"\""},
    {"priamos-robot --set \"${NOT_SET:-}\"", "--set: expected a value", "got \"\""},
    {"priamos topic echo SONAR_RANGES 'range_m[24]'", "bad index", "[0] to [23]"},
    {"priamos topic echo SONAR_RANGES 'range_m['", "bad index", "got \"[\""},
    {"priamos topic pub POSE pose_t '{\"xm\":1}'", "pose_t.xm: there is no such field", "\"x_m\""},
    {"priamos topic pub LINK_REQUEST link_request_t '{\"hold_s\":1e400}'", "out of range", "at most 1.8e308"},
    // names
    {"priamos topic list --bus onbord", "bus \"onbord\"", "\"onboard\""},
    {"priamos doctor --bus ofboard", "bus \"ofboard\"", "\"offboard\""},
    {"priamos type show pos_t", "unknown type \"pos_t\"", "\"pose_t\""},
    {"priamos link bits drive_comand_t", "unknown type \"drive_comand_t\"", "\"drive_command_t\""},
    {"priamos topic pub POSE pos_t '{}'", "unknown type \"pos_t\"", "\"pose_t\""},
    {"priamos topic echo POSE x_mm", "unknown field \"x_mm\"", "\"x_m\""},
    {"priamos topic echo SONAR_RANGES 'rnge_m[3]'", "unknown field \"rnge_m\"", "\"range_m\""},
    {"priamos run --scenario dor --deployment $SOURCE/config/sim", "got \"dor\"", "\"door\""},
    {"priamos up robto", "\"robto\"", "\"robot\""},
    {"priamos mission run round.tml --deployment $SOURCE/config/sim", "round.tml", ""},
    {"priamos mission door labratory --deployment $SOURCE/config/sim", "unknown door \"labratory\"",
     "\"laboratory\""},
    // configuration
    {"priamos-robot --config $SOURCE/config/sim/robot.toml --set drive.max_sped_m_s=1",
     "--set drive.max_sped_m_s=1:", "\"drive.follower.shape.max_speed_m_s\""},
    {"priamos-robot --set speed.max_sped_m_s=1",
     "--set speed.max_sped_m_s=1: speed.max_sped_m_s:", "\"drive.follower.shape.max_speed_m_s\""},
    {"priamos-planner --set mission.sped_m_s=1", "--set mission.sped_m_s=1:", "\"mission.speed_m_s\""},
    {"priamos-robot --config $SOURCE/config/sim/robto.toml", "robto.toml: expected a configuration file",
     "/config/sim/robot.toml\""},
    {"priamos-radio --set side=onbord", "got \"onbord\"", "\"onboard\""},
    {"priamos-teleop --set device=joystik", "got \"joystik\"", "\"joystick\""},
};

struct Answer {
  std::string text;
  int exit_code = -1;
  double cpu_s = 0;
};

/// All of them in one private network; what each printed, how it ended, and the time it computed.
std::vector<Answer> RunAll(const TemporaryFolder& folder) {
  std::string script = "PATH=$BIN:$PATH; TIMEFORMAT='%U %S'; cd " + folder.path().string() + "\n";
  for (std::size_t i = 0; i < kLines.size(); ++i)
    script += fmt::format("{{ time timeout 10 {} > {}.text 2>&1; }} 2> {}.time; echo $? > {}.code\n",
                          kLines[i].line, i, i, i);
  RunInPrivateNetwork(script, folder / "script.sh", 120);
  std::vector<Answer> answers;
  for (std::size_t i = 0; i < kLines.size(); ++i) {
    Answer answer;
    std::ostringstream text;
    text << std::ifstream(folder / fmt::format("{}.text", i)).rdbuf();
    answer.text = text.str();
    std::ifstream(folder / fmt::format("{}.code", i)) >> answer.exit_code;
    double user_s = 0, system_s = 0;
    std::ifstream(folder / fmt::format("{}.time", i)) >> user_s >> system_s;
    answer.cpu_s = user_s + system_s;
    answers.push_back(answer);
  }
  return answers;
}

TEST(WrongWords, AreNamedWithTheNearestRightOneAtOnce) {
  const TemporaryFolder folder;
  const auto answers = RunAll(folder);
  ASSERT_GE(kLines.size(), 30u);
  for (std::size_t i = 0; i < kLines.size(); ++i) {
    SCOPED_TRACE(kLines[i].line + "\n" + answers[i].text);
    EXPECT_EQ(answers[i].exit_code, 2);
    EXPECT_EQ(std::count(answers[i].text.begin(), answers[i].text.end(), '\n'), 1) << "one sentence";
    EXPECT_THAT(answers[i].text, HasSubstr(kLines[i].wrong));
    EXPECT_THAT(answers[i].text, HasSubstr(kLines[i].right));
    EXPECT_LT(answers[i].cpu_s, 1.0);
  }
}

TEST(Help, IsGivenForEveryProgramAndVerb) {
  const TemporaryFolder folder;
  const auto answer = RunInPrivateNetwork(R"sh(
    $BIN/priamos help > /dev/null && $BIN/priamos help topic list && $BIN/priamos --version && $BIN/priamos-robot --version
  )sh",
                                          folder / "script.sh");
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_THAT(answer.text, HasSubstr("Usage: priamos topic list"));
  EXPECT_THAT(answer.text, testing::ContainsRegex("priamos [0-9]+\\.[0-9]+\\.[0-9]+"));
  EXPECT_THAT(answer.text, testing::ContainsRegex("priamos-robot [0-9]+\\.[0-9]+\\.[0-9]+"));
}

}  // namespace
}  // namespace priamos
