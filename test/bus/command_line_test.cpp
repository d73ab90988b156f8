#include "bus/command_line.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <fstream>

#include "test/support/temporary_folder.hpp"

namespace priamos::bus {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// A small command line with everything a real one has.
struct Fixture {
  CLI::App cli{"a program", "prog"};
  std::uint64_t seed = 1;
  std::size_t keep = 0;
  int count = 0;
  double seconds = 2;
  std::string channel, format, logs;
  std::vector<int> dots;

  Fixture() {
    cli.require_subcommand(1);
    auto* topic = cli.add_subcommand("topic", "channels");
    topic->require_subcommand(1);
    topic->add_subcommand("list", "all")->add_flag("--json");
    auto* echo = topic->add_subcommand("echo", "one");
    echo->add_option("channel", channel, "LCM channel")->required();
    echo->add_option("--count", count, "how many");
    auto* run = cli.add_subcommand("run", "a run");
    run->add_option("--seed", seed, "noise");
    run->add_option("--logs", logs, "a folder");
    run->add_option("--keep", keep, "files");
    run->add_option("--seconds", seconds, "how long")->check(CLI::Range(0.1, 60.0));
    run->add_option("--format", format, "how")->check(CLI::IsMember({"csv", "jsonl", "mcap"}));
    run->add_option("--dots", dots, "columns and rows")->expected(2);
    cli.add_subcommand("status", "how it is");
  }

  /// "" when it was accepted.
  std::string Refusal(std::vector<std::string> words) {
    words.insert(words.begin(), "prog");
    std::vector<char*> argv;
    for (auto& word : words) argv.push_back(word.data());
    testing::internal::CaptureStderr();
    const auto code = ParseCommandLine(cli, static_cast<int>(argv.size()), argv.data());
    const std::string text = testing::internal::GetCapturedStderr();
    EXPECT_EQ(code.value_or(0), text.empty() ? 0 : 2);
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 1) << "one sentence";
    return text.substr(0, text.find('\n'));
  }
};

std::string Refusal(const std::vector<std::string>& words) {
  return Fixture().Refusal(words);
}

TEST(CommandLine, AnUnknownVerbIsNamedWithTheNearestOne) {
  EXPECT_EQ(Refusal({"tpoic"}), "prog: unknown verb \"tpoic\"; nearest: \"topic\" (prog --help lists all)");
  EXPECT_EQ(Refusal({"topic", "lst"}),
            "prog topic: unknown verb \"lst\"; nearest: \"list\" (prog topic --help lists all)");
  EXPECT_EQ(Refusal({"topic", "elephant"}),
            "prog topic: unknown verb \"elephant\" (prog topic --help lists all)");
}

TEST(CommandLine, AVerbOfAVerbIsFound) {
  EXPECT_THAT(Refusal({"echo", "POSE"}), HasSubstr("unknown verb \"echo\"; nearest: \"topic echo\""));
}

TEST(CommandLine, AnUnknownOptionIsNamedWithTheNearestOne) {
  EXPECT_EQ(
      Refusal({"topic", "list", "--jsno"}),
      "prog topic list: unknown option \"--jsno\"; nearest: \"--json\" (prog topic list --help lists all)");
  EXPECT_THAT(Refusal({"run", "--sed=3"}), HasSubstr("unknown option \"--sed\"; nearest: \"--seed\""));
}

TEST(CommandLine, AnOptionBeforeItsVerbIsRefusedWithWhereItBelongs) {
  EXPECT_EQ(Refusal({"--seed", "run"}).substr(0, 20), "prog: unknown option");
  EXPECT_THAT(Refusal({"--json", "topic", "list"}), HasSubstr("behind the verb: prog topic list --json"));
}

TEST(CommandLine, NoVerbIsAnsweredWithAllOfThem) {
  EXPECT_THAT(Refusal({}), StartsWith("prog: expected a verb, got none; one of run, status, topic ("));
  EXPECT_THAT(Refusal({"topic"}), StartsWith("prog topic: expected a verb, got none; one of echo, list ("));
}

TEST(CommandLine, ASuperfluousWordIsNamed) {
  EXPECT_EQ(Refusal({"status", "now"}),
            "prog status: expected no argument, got \"now\" (prog status --help lists all)");
  EXPECT_THAT(Refusal({"topic", "echo", "POSE", "x"}), HasSubstr("expected no further argument, got \"x\""));
}

TEST(CommandLine, WhatIsMissingIsNamed) {
  EXPECT_EQ(Refusal({"topic", "echo"}),
            "prog topic echo: expected channel (LCM channel), got none (prog topic echo --help lists all)");
  EXPECT_EQ(Refusal({"run", "--seed"}),
            "prog run: --seed: expected a whole number, 0 to 18446744073709551615, got none (prog run --help "
            "lists all)");
  EXPECT_THAT(Refusal({"run", "--dots", "6"}), HasSubstr("--dots: expected 2 values, got 1"));
}

TEST(CommandLine, AChoiceIsAnsweredWithTheNearestOne) {
  EXPECT_EQ(Refusal({"run", "--format", "cvs"}),
            "prog run: --format: expected one of csv, jsonl, mcap, got \"cvs\"; nearest: \"csv\"");
}

TEST(CommandLine, CountsAreNeitherNegativeNorTooLargeNorSomethingElse) {
  for (const char* bad : {"-1", "18446744073709551616", "1e3", "0x10", "1.5", "seven", ""})
    EXPECT_EQ(
        Refusal({"run", std::string("--seed=") + bad}),
        *bad ? fmt::format("prog run: --seed: expected a whole number, 0 to 18446744073709551615, got \"{}\"",
                           bad)
             : "prog run: --seed: expected a whole number, 0 to 18446744073709551615, got none (prog run "
               "--help lists all)");
  EXPECT_THAT(Refusal({"run", "--keep", "-2"}),
              HasSubstr("--keep: expected a whole number, 0 to 18446744073709551615"));
  EXPECT_THAT(Refusal({"topic", "echo", "POSE", "--count", "99999999999"}),
              HasSubstr("--count: expected a whole number"));
  Fixture good;
  EXPECT_EQ(good.Refusal({"run", "--seed", "010"}), "");
  EXPECT_EQ(good.seed, 10u) << "no octal";
}

TEST(CommandLine, ANumberBeyondWhatAnOptionCanHoldIsRefusedWithTheRange) {
  EXPECT_EQ(
      Refusal({"topic", "echo", "POSE", "--count", "99999999999"}),
      "prog topic echo: --count: expected a whole number, -2147483648 to 2147483647, got \"99999999999\"");
}

TEST(CommandLine, TextIsNeverEmpty) {
  EXPECT_EQ(Refusal({"topic", "echo", ""}),
            "prog topic echo: expected channel (LCM channel), got \"\" (prog topic echo --help lists all)");
  EXPECT_EQ(Refusal({"run", "--logs", ""}), "prog run: --logs: expected a value, got \"\"");
  EXPECT_EQ(Refusal({"run", "--logs", "a"}), "");
}

TEST(CommandLine, AnOptionIsGivenOnce) {
  EXPECT_EQ(Refusal({"run", "--seed", "3", "--seed", "4"}),
            "prog run: --seed is given twice; next: leave one");
  EXPECT_THAT(Refusal({"run", "--format=csv", "--format=csv", "--format=csv"}),
              HasSubstr("--format is given more than once"));
}

TEST(CommandLine, AFileThatDoesNotExistIsAnsweredWithTheNearestOne) {
  TemporaryFolder folder;
  std::ofstream(folder / "day.lcmlog") << "a log";
  Fixture fixture;
  std::string log;
  fixture.cli.get_subcommand("status")->add_option("log", log, "LCM log")->check(CLI::ExistingFile);
  const std::string wrong = folder / "day.lgo";
  EXPECT_EQ(fixture.Refusal({"status", wrong}),
            fmt::format("prog status: log: expected an existing file, got \"{}\"; nearest: \"{}\"", wrong,
                        (folder / "day.lcmlog").string()));
}

TEST(CommandLine, WhatIsThereButOfAnotherKindHasNoNearestName) {
  TemporaryFolder folder;
  std::ofstream(folder / "day.lcmlog") << "a log";
  Fixture fixture;
  std::string run, log;
  auto* status = fixture.cli.get_subcommand("status");
  status->add_option("run", run, "folder of a run")->check(CLI::ExistingDirectory);
  status->add_option("--from", log, "a log, or a folder")->check(CLI::ExistingPath);
  const std::string file = folder / "day.lcmlog", missing = "/nowhere/at/all";
  EXPECT_EQ(fixture.Refusal({"status", file}),
            fmt::format("prog status: run: expected an existing folder, got \"{}\"", file));
  EXPECT_THAT(fixture.Refusal({"status", "--from", missing}),
              HasSubstr("--from: expected an existing file or folder, got \"/nowhere/at/all\""));
}

TEST(CommandLine, NumbersAreFiniteAndInTheirRange) {
  for (const char* bad : {"nan", "inf", "0", "61", "long"})
    EXPECT_EQ(Refusal({"run", "--seconds", bad}),
              fmt::format("prog run: --seconds: expected a number, 0.1 to 60, got \"{}\"", bad));
  Fixture good;
  EXPECT_EQ(good.Refusal({"run", "--seconds", "0.5"}), "");
  EXPECT_EQ(good.seconds, 0.5);
}

TEST(CommandLine, AnswersItsVersion) {
  Fixture dut;
  const char* argv[] = {"prog", "--version"};
  testing::internal::CaptureStdout();
  EXPECT_EQ(ParseCommandLine(dut.cli, 2, const_cast<char**>(argv)), 0);
  EXPECT_THAT(testing::internal::GetCapturedStdout(),
              testing::ContainsRegex("^prog [0-9]+\\.[0-9]+\\.[0-9]+"));
}

TEST(CommandLine, HelpOfAVerbHasItsFullName) {
  Fixture dut;
  EXPECT_THAT(HelpOf(*dut.cli.get_subcommand("topic")->get_subcommand("echo")), HasSubstr("prog topic echo"));
}

}  // namespace
}  // namespace priamos::bus
