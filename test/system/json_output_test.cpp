// Every verb that prints something prints JSON with --json, and nothing else on standard output. The verbs
// come from the command line itself, so a new one cannot be forgotten.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bus/command_line.hpp"
#include "cli/verbs/commands.hpp"
#include "test/support/temporary_folder.hpp"
#include "test/system/private_network.hpp"

namespace priamos {
namespace {

/// A verb and what it is given. Those marked `streams` run until Ctrl-C, which comes a while after their
/// first word.
struct Call {
  std::string verb, arguments;
  bool streams = false;
};

/// In this order, beside a running `up sim`. $LOG is a recorded log, $O where things are written.
const std::vector<Call> kCalls{
    {"status", "--logs $O/up"},
    {"logs", "--logs $O/up"},
    {"restart", "offboard-teleop"},
    {"doctor", ""},
    {"topic list", "--seconds 1"},
    {"topic hz", "POSE --seconds 1"},
    {"topic bw", "POSE --seconds 1"},
    {"topic echo", "POSE x_m y_m --count 2"},
    {"topic url", ""},
    {"topic pub", "LINK_REQUEST link_request_t '{\"utime\":0,\"channel\":\"SONAR_RANGES\",\"hold_s\":1}'"},
    {"topic serve", "--port 0", true},
    {"where", ""},
    {"place", "2 2.4 0"},
    {"mission status", ""},
    {"mission door", "laboratory --deployment $SOURCE/config/sim"},
    {"map export", "$O/plan.toml --logs $O/up --deployment $SOURCE/config/sim"},
    {"map reset", ""},
    {"view", "--once --for 80"},
    {"mission pause", ""},
    {"mission resume", ""},
    {"mission list", ""},
    {"mission abort", ""},
    {"mission goto", "3 2.4"},
    {"mission corridor", "5"},
    {"mission explore", ""},
    {"mission locate", ""},
    {"mission patrol", "3 2.4 4 2.4"},
    {"mission elevator", "cabin --deployment $O/lift"},
    {"mission run", "$SOURCE/config/sim/missions/round.toml --deployment $SOURCE/config/sim"},
    {"mission cancel", "4711"},
    {"param list", "robot --deployment $SOURCE/config/sim"},
    {"param get", "robot"},
    {"param set", "robot drive.blocked_s 0.6"},
    {"param save", "robot"},
    {"param reset", "robot"},
    {"estop", ""},
    {"link top", "--once"},
    {"link emulate", "--a $O/a --b $O/b", true},
    {"link keygen", "$O/key"},
    {"link rekey", "$O/key"},
    {"link bits", "pose_t"},
    {"link budget", "$SOURCE/config/sim/link.toml"},
    {"link table", "$SOURCE/config/sim/link.toml"},
    {"log record", "$O/record.lcmlog --seconds 1"},
    {"log info", "$LOG"},
    {"log index", "$LOG"},
    {"log filter", "$LOG $O/short.lcmlog --to 2"},
    {"log mrpt", "$O/short.lcmlog $O/short.rawlog"},
    {"log export", "$O/short.lcmlog mcap --out $O/short.mcap"},
    {"log repair", "$O/short.lcmlog $O/whole.lcmlog"},
    {"log merge", "$LOG $SOURCE/logs/recorded/door-offboard.lcmlog $O/merged.lcmlog --offset 0"},
    {"log play", "$O/short.lcmlog --speed max --bus 'udpm://239.255.76.69:7999?ttl=0'"},
    {"replay verify", "$O/short.lcmlog --module planner --deployment $SOURCE/config/sim"},
    {"replay show", "$LOG --port 0", true},
    {"report", "$O/one $O/other --out $O/two.html"},
    {"type show", "pose_t"},
    {"type hash", "pose_t"},
    {"type channels", ""},
    {"world generate", "--into $O/generated --deployment $SOURCE/config/sim"},
    {"calibrate", "--points $O/points.txt"},
    {"down", "--logs $O/up"},
    {"up", "$SOURCE/config/sim --detach --logs $O/up2"},
    {"run", "--deployment $SOURCE/config/sim --logs $O/run", true},
    {"lockstep", "--deployment $SOURCE/config/sim"},
};

/// Verbs without --json, and why.
const std::map<std::string, std::string> kWithout{
    {"link listen", "prints nothing"},
    {"help", "text for people"},
    {"world keys", "TOML"},
    {"locate", "writes JSON into the file that is named, line by line"},
    {"see", "writes files: the drawings, and JSON into the file that is named"},
    {"completion bash", "a script for the shell"},
    {"completion zsh", "a script for the shell"},
    {"completion fish", "a script for the shell"},
    {"completion words", "what the shells ask, line by line"},
    {"manual", "writes files, and prints nothing"},
};

std::vector<const CLI::App*> Leaves(const CLI::App& app) {
  const auto verbs = app.get_subcommands([](const CLI::App*) { return true; });
  if (verbs.empty()) return {&app};
  std::vector<const CLI::App*> leaves;
  for (const auto* verb : verbs)
    for (const auto* leaf : Leaves(*verb)) leaves.push_back(leaf);
  return leaves;
}

std::string NameOf(const CLI::App& verb) {
  return bus::FullName(verb).substr(std::string("priamos ").size());
}

TEST(JsonOutput, EveryVerbHasItOrAReasonNotTo) {
  int code = 0;
  CLI::App cli("", "priamos");
  cli::AddCommands(cli, code);
  for (const auto* verb : Leaves(cli)) {
    const std::string name = NameOf(*verb);
    const auto* json = verb->get_option_no_throw("--json");
    const bool has = json != nullptr && json->get_expected_min() == 0;
    EXPECT_NE(has, kWithout.contains(name)) << name;
    const auto calls =
        std::count_if(kCalls.begin(), kCalls.end(), [&](const Call& call) { return call.verb == name; });
    EXPECT_EQ(calls, has ? 1 : 0) << name << " is to be tried below";
  }
}

/// One document, or one per line.
bool IsJson(const std::string& text) {
  if (nlohmann::json::accept(text)) return true;
  std::istringstream lines(text);
  std::size_t n = 0;
  for (std::string line; std::getline(lines, line); ++n)
    if (!nlohmann::json::accept(line)) return false;
  return n > 0;
}

std::string Read(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// A camera of 500 px focal length that looks at eight corners and four other points of space.
std::string PointsOfACamera() {
  std::string text;
  for (const double x : {-0.5, 0.4})
    for (const double y : {-0.3, 0.35})
      for (const double z : {2.0, 2.7, 3.5})
        text += fmt::format("{} {} {} {} {}\n", x, y, z, 384 + 500 * x / z, 288 + 500 * y / z);
  return text;
}

TEST(JsonOutput, OfEveryVerbIsNothingButJson) {
  const TemporaryFolder folder;
  std::ofstream(folder / "points.txt") << PointsOfACamera();
  for (const char* run : {"one", "other"}) {
    std::filesystem::create_directory(folder / run);
    std::ofstream(std::filesystem::path(folder / run) / "summary.json") << R"({"passed": true})";
  }
  const std::string helpers = R"sh(
    stream() {  # OUT ERR COMMAND...
      local out=$1 err=$2; shift 2
      env --default-signal=INT "$@" > $out 2> $err & local pid=$!
      until [ -s $out ] || [ -s $err ] || ! kill -0 $pid; do sleep 0.1; done
      sleep 3; kill -INT $pid; wait $pid
    }
    ready() { for i in $(seq 200); do $BIN/priamos status --logs $O/up > /dev/null && return; sleep 0.2; done; }
)sh";
  std::string script =
      helpers + "O=" + folder.path().string() + "; LOG=$SOURCE/logs/recorded/door-onboard.lcmlog; cd $O\n" +
      "cp -r $SOURCE/config/sim $O/lift; sed -i 's#^map = .*#map = \"maps/elevator.toml\"#' "
      "$O/lift/planner.toml\n" +
      "$BIN/priamos up $SOURCE/config/sim --detach --logs $O/up > up.text || cat up.text\nready\n";
  for (std::size_t i = 0; i < kCalls.size(); ++i)
    script += kCalls[i].streams ? fmt::format("stream {}.out {}.err $BIN/priamos {} --json {}\n", i, i,
                                              kCalls[i].verb, kCalls[i].arguments)
                                : fmt::format("timeout 90 $BIN/priamos {} --json {} > {}.out 2> {}.err\n",
                                              kCalls[i].verb, kCalls[i].arguments, i, i);
  script += "$BIN/priamos down --logs $O/up2 > down.text; $BIN/priamos down --logs $O/up >> down.text\n";
  const auto answer = RunInPrivateNetwork(script, folder / "script.sh", 280);
  for (std::size_t i = 0; i < kCalls.size(); ++i) {
    const std::string out = Read(folder / fmt::format("{}.out", i));
    EXPECT_TRUE(IsJson(out)) << kCalls[i].verb << " " << kCalls[i].arguments << "\n"
                             << out << "\n"
                             << Read(folder / fmt::format("{}.err", i)) << answer.text;
  }
}

}  // namespace
}  // namespace priamos
