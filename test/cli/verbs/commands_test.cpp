#include "cli/verbs/commands.hpp"

#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <functional>

#include "bus/command_line.hpp"
#include "cli/front/run_cli.hpp"
#include "test/cli/priamos_answer.hpp"

namespace priamos::cli {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;
using Words = std::vector<std::string>;

/// What every verb keeps to, asked of all of them.
class Commands : public testing::Test {
 protected:
  using Visit = std::function<void(const CLI::App&, const Words&)>;

  Commands() { AddCommands(cli_, code_); }
  /// Calls `visit` for every verb that a person sees and that has no verbs of its own.
  void ForEachVerb(const Visit& visit) { Walk(cli_, {}, visit); }
  static void Walk(const CLI::App& app, const Words& words, const Visit& visit) {
    const auto verbs = app.get_subcommands([](const CLI::App* verb) { return !verb->get_group().empty(); });
    if (verbs.empty()) visit(app, words);
    for (const auto* verb : verbs) {
      Words deeper = words;
      deeper.push_back(verb->get_name());
      Walk(*verb, deeper, visit);
    }
  }
  static std::string Joined(const Words& words) {
    std::string line = "priamos";
    for (const std::string& word : words) line += " " + word;
    return line;
  }
  CLI::App cli_{"", "priamos"};
  int code_ = 0;
};

TEST_F(Commands, EveryVerbHasAnExampleThatNamesIt) {
  ForEachVerb([](const CLI::App& verb, const Words& words) {
    EXPECT_THAT(verb.get_footer(), HasSubstr("Example")) << Joined(words);
    EXPECT_THAT(verb.get_footer(), HasSubstr(Joined(words)));
  });
}

TEST_F(Commands, EveryVerbAndOptionSaysWhatItIsFor) {
  ForEachVerb([](const CLI::App& verb, const Words& words) {
    EXPECT_THAT(verb.get_description(), Not(IsEmpty())) << Joined(words);
    EXPECT_TRUE(verb.get_description().ends_with('.')) << Joined(words) << ": " << verb.get_description();
    for (const auto* option : verb.get_options())
      EXPECT_THAT(option->get_description(), Not(IsEmpty())) << Joined(words) << " " << option->get_name();
  });
}

TEST_F(Commands, EveryOptionOfAnExampleIsOneOfTheVerb) {
  ForEachVerb([](const CLI::App& verb, const Words& words) {
    std::istringstream footer(verb.get_footer());
    std::string word;
    bool this_verb = false;  // an example may go on with another one
    for (std::string before; footer >> word; before = word) {
      if (word == "priamos") this_verb = true;
      if (before == "priamos" && word != words.front()) this_verb = false;
      if (!this_verb || !word.starts_with("--")) continue;
      const std::string name = word.substr(0, word.find_first_of(",;."));
      EXPECT_NE(verb.get_option_no_throw(name), nullptr) << Joined(words) << ": " << name;
    }
  });
}

TEST_F(Commands, HelpOfEveryVerbIsAnsweredWithItsExample) {
  ForEachVerb([](const CLI::App& verb, const Words& words) {
    EXPECT_THAT(bus::HelpOf(verb),
                AllOf(HasSubstr(verb.get_description()), HasSubstr("Usage: " + Joined(words))))
        << Joined(words);
  });
}

TEST_F(Commands, AnUnknownOptionOfAnyVerbIsNamedWithExitCodeTwo) {
  ForEachVerb([](const CLI::App&, const Words& words) {
    Words line = words;
    line.push_back("--no-such-option");
    const auto answer = Priamos(line);
    EXPECT_EQ(answer.exit_code, 2) << Joined(words);
    EXPECT_EQ(LinesOf(answer.err).size(), 1u) << answer.err;
    EXPECT_THAT(answer.err, StartsWith("priamos")) << answer.err;
    EXPECT_EQ(answer.out, "");
  });
}

/// Whatever else a line lacks, a number that is none is told first or not at all; it is never taken.
TEST_F(Commands, NoVerbTakesAWordForANumber) {
  int tried = 0;
  ForEachVerb([&](const CLI::App& verb, const Words& words) {
    for (const auto* option : verb.get_options()) {
      const std::string type = option->get_type_name();
      const bool number = type.starts_with("INT") || type.starts_with("UINT") || type.starts_with("FLOAT");
      if (!number || option->get_positional() || option->get_items_expected_max() == 0) continue;
      ++tried;
      Words line = words;
      line.push_back(option->get_lnames().empty() ? option->get_name() : "--" + option->get_lnames().front());
      for (int i = 0; i < option->get_items_expected_min(); ++i) line.emplace_back("many");
      EXPECT_EQ(Priamos(line).exit_code, 2) << Joined(line);
    }
  });
  EXPECT_GT(tried, 40);
}

TEST_F(Commands, WithoutAVerbAllAreNamed) {
  const auto answer = Priamos({});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err,
              StartsWith("priamos: expected a verb, got none; one of calibrate, completion, doctor"));
  for (const auto* verb : cli_.get_subcommands([](const CLI::App* v) { return !v->get_group().empty(); }))
    EXPECT_THAT(answer.err, HasSubstr(verb->get_name()));
}

TEST_F(Commands, AMistypedVerbIsAnsweredWithTheNearest) {
  EXPECT_THAT(Priamos({"topik"}).err, HasSubstr("unknown verb \"topik\"; nearest: \"topic\""));
  EXPECT_THAT(Priamos({"log", "ifo"}).err, HasSubstr("priamos log: unknown verb \"ifo\"; nearest: \"info\""));
  EXPECT_THAT(Priamos({"echo"}).err, HasSubstr("nearest: \"topic echo\""));
}

TEST_F(Commands, HelpOfAVerbOfAVerbIsTheSameAsBehindIt) {
  EXPECT_EQ(Priamos({"help", "topic", "echo"}).out, Priamos({"topic", "echo", "--help"}).out);
  EXPECT_EQ(Priamos({"help"}).out, Priamos({"--help"}).out);
}

TEST_F(Commands, HelpOnNoVerbIsRefusedWithTheNearest) {
  const auto answer = Priamos({"help", "topic", "ecko"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("nearest: \"echo\""));
}

/// CLI11 also fills in the environment for the verbs that were not typed.
TEST(BusOfAVerb, TheOneThatIsTypedWinsOverTheEnvironment) {
  for (const Words& words :
       {Words{"topic", "url"}, Words{"topic", "list"}, Words{"topic", "hz", "POSE"},
        Words{"topic", "bw", "POSE"}, Words{"topic", "pub", "POSE", "pose_t", "{}"},
        Words{"topic", "echo", "POSE"}, Words{"mission", "status"}, Words{"mission", "abort"}, Words{"where"},
        Words{"view"}, Words{"link", "top"}, Words{"estop"}}) {
    CLI::App cli("all verbs", "priamos");
    int exit_code = 0;
    AddCommands(cli, exit_code);
    setenv("PRIAMOS_BUS", "file:///dev/null?mode=r", 1);
    Words line = words;
    line.insert(line.begin(), "priamos");
    line.insert(line.end(), {"--bus", "typed"});
    std::vector<char*> argv;
    for (std::string& word : line) argv.push_back(word.data());
    testing::internal::CaptureStderr();
    EXPECT_EQ(RunCli(cli, static_cast<int>(argv.size()), argv.data(), exit_code), 2)
        << line[1] << " " << line[2];
    EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("typed")) << line[1] << " " << line[2];
    unsetenv("PRIAMOS_BUS");
  }
}

}  // namespace
}  // namespace priamos::cli
