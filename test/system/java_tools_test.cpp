#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include "bus/log/log_reader.hpp"
#include "private_network.hpp"
#include "test/support/temporary_folder.hpp"

// LCM's own windows under Xvfb, started as priamos-spy and priamos-logplayer start them, beside a
// recorded door run. The screenshots stay in the build folder: test/screenshots.

namespace priamos {
namespace {

namespace fs = std::filesystem;

const std::string kJars = "/usr/share/java/lcm.jar:/usr/share/java/jchart2d.jar:" PRIAMOS_BINARY_DIR
                          "/java/priamos-types.jar:" PRIAMOS_BINARY_DIR "/java/priamos-spy.jar";
const std::string kUrl = "udpm://239.255.76.67:7667?ttl=0";
const std::string kRecorded = PRIAMOS_SOURCE_DIR "/logs/recorded/door-onboard.lcmlog";

/// Messages per channel.
std::map<std::string, int> CountsOf(const std::string& log) {
  bus::LogReader reader(log);
  std::map<std::string, int> counts;
  while (const auto event = reader.Next()) ++counts[event->channel];
  return counts;
}

class JavaTools : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(PRIAMOS_BINARY_DIR "/java/priamos-spy.jar"))
      GTEST_SKIP() << "no Java; scripts/setup scripts/packages-java.txt installs it";
    if (!fs::exists("/usr/bin/Xvfb")) GTEST_SKIP() << "no Xvfb; sudo apt-get install xvfb";
    fs::create_directories(fs::path(picture_).parent_path());
    fs::remove(picture_);
  }
  /// `probe` is compiled and run under Xvfb, in one network with what `around` starts and `after` ends.
  ShellAnswer RunProbe(const std::string& probe, const std::string& main_and_arguments,
                       const std::string& before, const std::string& after) {
    std::ostringstream script;
    script << "cd " << folder_.path().string() << "\nexport HOME=$PWD XDG_RUNTIME_DIR=$PWD\n"
           << "cp " << kRecorded << " run.lcmlog\n"
           << "javac -nowarn -cp " << kJars << " -d . $SOURCE/test/system/spy/" << probe
           << ".java || exit 3\n"
           << "Xvfb -displayfd 3 -screen 0 1280x1024x24 -nolisten tcp 3>display 2>/dev/null & screen=$!\n"
           << "until [ -s display ]; do sleep 0.05; done; export DISPLAY=:$(cat display)\n"
           << before << "\n"
           << "java -Djava.net.preferIPv4Stack=true -Xmx256m -cp .:" << kJars << " " << main_and_arguments
           << " \"" << picture_ << "\"; code=$?\n"
           << after << "\nkill $screen; exit $code\n";
    return RunInPrivateNetwork(script.str(), folder_ / "script.sh", 60);
  }
  TemporaryFolder folder_;
  /// The name of a test with a parameter has a slash in it.
  static std::string PictureName() {
    std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    std::replace(name.begin(), name.end(), '/', '-');
    return name + ".png";
  }
  std::string picture_ = std::string(PRIAMOS_BINARY_DIR "/test/screenshots/") + PictureName();
};

struct SpyRow {
  std::string type;
  int messages = 0, undecodable = 0;
};

std::map<std::string, SpyRow> SpyRows(const std::string& text) {
  std::map<std::string, SpyRow> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string first, name;
    SpyRow row;
    if (words >> first >> name >> row.type >> row.messages >> row.undecodable && first == "channel")
      rows[name] = row;
  }
  return rows;
}

/// A recorded door run that somebody plays, as a person who looks at a log has it.
class SpyOnALog : public JavaTools, public testing::WithParamInterface<const char*> {};

TEST_P(SpyOnALog, LcmSpyDecodesEveryChannelAndDrawsTheSonarRing) {
  const auto answer = RunProbe("SpyProbe", "lcm.spy.SpyProbe '" + kUrl + "' 5",
                               "export LCM_DEFAULT_URL='" + kUrl + "'\n(sleep 2.5; exec " +
                                   std::string(GetParam()) + ") > played 2>&1 & player=$!",
                               "kill -INT $player 2>/dev/null; wait $player");
  ASSERT_EQ(answer.exit_code, 0) << answer.text;
  const auto rows = SpyRows(answer.text);
  for (const auto& [channel, row] : rows) {
    EXPECT_EQ(row.type.substr(0, 8), "priamos.") << channel;
    EXPECT_EQ(row.undecodable, 0) << channel;
  }
  for (const char* channel : {"POSE", "SONAR_RANGES", "WHEEL_STATE", "ODOMETRY", "HEALTH"})
    EXPECT_TRUE(rows.contains(channel) && rows.at(channel).messages > 0) << channel << "\n" << answer.text;
  EXPECT_THAT(answer.text, testing::HasSubstr("plugin priamos.spy.SonarRing for SONAR_RANGES"));
  EXPECT_GT(fs::file_size(picture_), 10'000u);
  std::cout << "screenshot: " << picture_ << "\n";
}

INSTANTIATE_TEST_SUITE_P(
    Player, SpyOnALog,
    testing::Values("$BIN/priamos log play run.lcmlog --speed 4 --loop --bus $LCM_DEFAULT_URL",
                    "lcm-logplayer -s 4 run.lcmlog"),
    [](const auto& info) { return info.index == 0 ? "OfPriamos" : "OfLcm"; });

TEST_F(JavaTools, TheLogPlayersWindowPlaysEveryChannelOfOurLogs) {
  const auto answer =
      RunProbe("PlayerProbe", "PlayerProbe '" + kUrl + "' run.lcmlog 5",
               "lcm-logger --lcm-url='" + kUrl + "' --flush-interval=50 -q out.lcmlog & logger=$!; listening",
               "sleep 0.3; kill -INT $logger; wait $logger");
  ASSERT_EQ(answer.exit_code, 0) << answer.text;
  // It plays in real time: what comes in the first four seconds is there, as often as it was recorded.
  const auto recorded = CountsOf(kRecorded), played = CountsOf(folder_ / "out.lcmlog");
  for (const char* channel : {"POSE", "SONAR_RANGES", "WHEEL_STATE", "ODOMETRY", "HEALTH"}) {
    EXPECT_GT(played.contains(channel) ? played.at(channel) : 0, 1) << channel << "\n" << answer.text;
  }
  for (const auto& [channel, n] : played) EXPECT_TRUE(recorded.contains(channel)) << channel;
  EXPECT_GT(fs::file_size(picture_), 3'000u);
  std::cout << "screenshot: " << picture_ << "\n";
}

}  // namespace
}  // namespace priamos
