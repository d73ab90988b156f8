#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "test/support/shell.hpp"
#include "test/support/temporary_folder.hpp"

// `priamos calibrate` as a person runs it: interrupted in the middle, and with input that is of no use.

namespace priamos {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string ReadFile(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::ptrdiff_t Lines(const std::filesystem::path& path) {
  const std::string text = ReadFile(path);
  return std::count(text.begin(), text.end(), '\n');
}

const std::string kPriamos = std::string(PRIAMOS_BINARY_DIR) + "/bin/priamos";

ShellAnswer RunPriamos(const std::string& arguments) {
  return RunShell("timeout 250 '" + kPriamos + "' " + arguments);
}

class CalibrationTest : public testing::Test {
 protected:
  std::string Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  /// The simulated deployment with the smallest plan there is.
  std::string SmallDeployment() const {
    const std::filesystem::path to = folder_ / "sim";
    std::filesystem::copy(PRIAMOS_SOURCE_DIR "/config/sim", to, std::filesystem::copy_options::recursive);
    std::filesystem::remove(to / "kastor.yaml");
    std::string head = ReadFile(to / "head.toml");
    for (const char* nodes : {"nodes = 7", "nodes = 4"}) {
      const auto at = head.find(nodes);
      EXPECT_NE(at, std::string::npos);
      head.replace(at, 9, "nodes = 2");
    }
    std::ofstream(to / "head.toml") << head;
    return to;
  }
  /// Starts a calibration and kills it as no process can notice, once `exposures` are in the journal.
  void KillAfter(const std::string& deployment, int exposures) const {
    const pid_t child = fork();
    if (child == 0) {
      const std::string log = folder_ / "first.txt";
      if (!freopen(log.c_str(), "w", stdout) || !freopen(log.c_str(), "a", stderr)) _exit(127);
      execl(kPriamos.c_str(), "priamos", "calibrate", "--deployment", deployment.c_str(), "--output",
            (deployment + "/kastor.yaml").c_str(), nullptr);
      _exit(127);
    }
    const auto journal = std::filesystem::path(deployment) / "kastor.yaml.journal";
    for (int i = 0; i < 2000 && Lines(journal) < exposures + 1; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    ASSERT_GE(Lines(journal), exposures + 1) << ReadFile(folder_ / "first.txt");
  }

  TemporaryFolder folder_;
};

TEST_F(CalibrationTest, GoesOnAfterKill9InTheMiddle) {
  const std::filesystem::path deployment = SmallDeployment();
  std::ofstream(deployment / "kastor.yaml") << "the old table\n";
  KillAfter(deployment, 5);
  EXPECT_EQ(ReadFile(deployment / "kastor.yaml"), "the old table\n");
  const auto done = Lines(deployment / "kastor.yaml.journal") - 1;
  const ShellAnswer answer = RunPriamos("calibrate --deployment " + deployment.string() + " --output " +
                                        (deployment / "kastor.yaml").string());
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_THAT(answer.text, HasSubstr("goes on after"));
  EXPECT_THAT(answer.text, Not(HasSubstr("; 1 of "))) << "what was finished is not done again";
  EXPECT_GE(done, 5);
  EXPECT_THAT(ReadFile(deployment / "kastor.yaml"), HasSubstr("number_of_nodes"));
  EXPECT_FALSE(std::filesystem::exists(deployment / "kastor.yaml.journal"));
  EXPECT_TRUE(std::filesystem::exists(deployment / "kastor.yaml-report/index.html"));
}

struct BadInput {
  const char *name, *option, *text, *why;
};

class BadCalibrationInput : public CalibrationTest, public testing::WithParamInterface<BadInput> {};

TEST_P(BadCalibrationInput, OneSentenceExitCode2AndTheOldFileUntouched) {
  const BadInput& bad = GetParam();
  const std::string input = Write(bad.name, bad.text), output = Write("old.json", "{\"old\": true}\n");
  const ShellAnswer answer =
      RunPriamos(std::string("calibrate ") + bad.option + " " + input + " --output " + output);
  EXPECT_EQ(answer.exit_code, 2) << answer.text;
  EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 1) << answer.text;
  EXPECT_THAT(answer.text, HasSubstr(bad.why));
  EXPECT_EQ(ReadFile(output), "{\"old\": true}\n");
}

INSTANTIATE_TEST_SUITE_P(
    , BadCalibrationInput,
    testing::Values(
        BadInput{"few.txt", "--points", "0 0 0 1 1\n1 0 0 2 1\n0 1 0 1 2\n", "at least 6 points, got 3"},
        BadInput{"nan.txt", "--points", "0 0 0 nan 1\n", "nan.txt:1: expected five finite numbers"},
        BadInput{"columns.txt", "--points", "0 0 0 1\n",
                 "columns.txt:1: expected five numbers X Y Z u v, got 4"},
        BadInput{"flat.txt", "--points",
                 "0 0 0 1 1\n1 0 0 9 1\n0 1 0 1 9\n1 1 0 9 9\n2 1 0 17 9\n2 3 0 17 25\n0 4 0 1 33\n",
                 "all points lie in one plane"},
        BadInput{"picture.png", "--photo", "this is no picture", "picture.png: expected an image"},
        BadInput{"laser.toml", "--laser", "[[view]]\nimage = 3\n", "laser.toml:2"}),
    [](const auto& info) {
      std::string name = info.param.name;
      return name.substr(0, name.find('.'));
    });

TEST_F(CalibrationTest, ATruncatedTableIsRefusedAndStays) {
  const std::string whole = ReadFile(PRIAMOS_SOURCE_DIR "/config/sim/kastor.yaml");
  const std::string table = Write("kastor.yaml", whole.substr(0, whole.size() / 2));
  const std::string pictures = Write("laser.toml", "[[view]]\nimage = \"floor.png\"\n");
  const ShellAnswer answer = RunPriamos("calibrate --laser " + pictures + " --table " + table);
  EXPECT_EQ(answer.exit_code, 2) << answer.text;
  EXPECT_THAT(answer.text, HasSubstr("kastor.yaml: "));
  EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 1) << answer.text;
  EXPECT_EQ(ReadFile(table), whole.substr(0, whole.size() / 2));
}

}  // namespace
}  // namespace priamos
