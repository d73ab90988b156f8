#include "cli/front/run_cli.hpp"

#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>

namespace priamos::cli {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// A program with one verb, `try`, that does what a test says.
class RunCliTest : public testing::Test {
 protected:
  int Run(std::vector<std::string> words, const std::function<void()>& act) {
    CLI::App cli("a program", "priamos");
    auto* verb = cli.add_subcommand("try", "to try");
    verb->callback([&] { act(); });
    words.insert(words.begin(), "priamos");
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    const int code = RunCli(cli, static_cast<int>(argv.size()), argv.data(), exit_code_);
    out_ = testing::internal::GetCapturedStdout();
    err_ = testing::internal::GetCapturedStderr();
    return code;
  }
  int exit_code_ = 0;
  std::string out_, err_;
};

TEST_F(RunCliTest, TheCodeIsWhatTheVerbLeft) {
  EXPECT_EQ(Run({"try"}, [&] { exit_code_ = 1; }), 1);
  EXPECT_EQ(Run({"try"}, [&] { exit_code_ = 0; }), 0);
  EXPECT_EQ(err_, "");
}

TEST_F(RunCliTest, HelpIsNoFailureAndRunsNothing) {
  EXPECT_EQ(Run({"try", "--help"}, [] { FAIL() << "it ran"; }), 0);
  EXPECT_THAT(out_, HasSubstr("Usage: priamos try"));
}

TEST_F(RunCliTest, TheVersionIsThatOfTheProgram) {
  EXPECT_EQ(Run({"--version"}, [] {}), 0);
  EXPECT_THAT(out_, StartsWith("priamos "));
}

TEST_F(RunCliTest, AnExceptionIsOneSentenceBehindTheVerbAndCodeTwo) {
  EXPECT_EQ(Run({"try"}, [] { throw std::runtime_error("a.toml: expected a map, got none"); }), 2);
  EXPECT_EQ(err_, "priamos try: a.toml: expected a map, got none\n");
}

TEST_F(RunCliTest, AFolderThatCannotBeUsedIsNamedWithTheNextStep) {
  EXPECT_EQ(Run({"try"}, [] { std::filesystem::create_directory("/proc/nothing-can-be-made-here"); }), 2);
  EXPECT_THAT(err_,
              StartsWith("priamos try: /proc/nothing-can-be-made-here: No such file or directory; next: "));
  EXPECT_THAT(err_, testing::Not(HasSubstr("filesystem error"))) << "no text of an exception";
}

TEST_F(RunCliTest, AWrongWordIsCodeTwoBeforeAnythingRuns) {
  EXPECT_EQ(Run({"tri"}, [] { FAIL() << "it ran"; }), 2);
  EXPECT_THAT(err_, HasSubstr("unknown verb \"tri\"; nearest: \"try\""));
}

}  // namespace
}  // namespace priamos::cli
