#include "cli/verbs/help/completion.hpp"

#include <gmock/gmock.h>

#include <CLI/CLI.hpp>

#include "cli/verbs/help/commands.hpp"
#include "cli/verbs/log/commands.hpp"
#include "cli/verbs/run/commands.hpp"
#include "cli/verbs/wire/commands.hpp"
#include "test/cli/priamos_answer.hpp"

namespace priamos::cli {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;
using Words = std::vector<std::string>;

class Completion : public testing::Test {
 protected:
  Completion() {
    AddRunCommand(cli_, code_);
    AddTopicCommand(cli_, code_);
    AddLogCommand(cli_, code_);
    AddReplayCommand(cli_, code_);
    AddTypeCommand(cli_, code_);
    AddDoctorCommand(cli_, code_);
    AddCompletionCommand(cli_, code_);
  }
  Words Of(const Words& words) const { return Completions(cli_, words); }
  CLI::App cli_{"", "priamos"};
  int code_ = 0;
};

TEST_F(Completion, Verbs) {
  EXPECT_THAT(Of({"to"}), ElementsAre("topic"));
  EXPECT_THAT(Of({"topic", "e"}), ElementsAre("echo"));
  EXPECT_THAT(Of({"log", "re"}), ElementsAre("record", "repair"));
  EXPECT_THAT(Of({"completion", ""}), Not(Contains("words")));
}

TEST_F(Completion, Options) {
  EXPECT_THAT(Of({"topic", "list", "--w"}), ElementsAre("--watch"));
  EXPECT_THAT(Of({"log", "play", "a.lcmlog", "--sp"}), ElementsAre("--speed"));
}

TEST_F(Completion, ChannelsAndTypes) {
  EXPECT_THAT(Of({"topic", "echo", "POSE"}), ElementsAre("POSE", "POSE_CORRECTION", "POSE_RESET"));
  EXPECT_THAT(Of({"topic", "pub", "POSE", "pos"}),
              ElementsAre("pose_correction_t", "pose_reset_t", "pose_t"));
  EXPECT_THAT(Of({"log", "filter", "a", "b", "--channels", "SON"}), ElementsAre("SONAR_RANGES"));
}

TEST_F(Completion, LimitedValues) {
  EXPECT_THAT(Of({"log", "export", "a.lcmlog", ""}), testing::UnorderedElementsAre("csv", "jsonl", "mcap"));
  EXPECT_THAT(Of({"replay", "verify", "a", "--module", "ro"}), ElementsAre("robot"));
}

TEST_F(Completion, AnOptionBeforeAnArgumentTakesNoneOfItsPlaces) {
  for (const Words& option : {Words{"--bus", "onboard"}, Words{"--bus=onboard"}, Words{"--json"}}) {
    Words words{"topic", "echo"};
    words.insert(words.end(), option.begin(), option.end());
    words.emplace_back("POSE_");
    EXPECT_THAT(Of(words), ElementsAre("POSE_CORRECTION", "POSE_RESET")) << option.front();
  }
}

TEST_F(Completion, AnOptionThatWantsAValueIsNotFollowedByAnOption) {
  EXPECT_THAT(Of({"log", "filter", "a", "b", "--without", "WHEEL_C"}), ElementsAre("WHEEL_COMMAND"));
  EXPECT_THAT(Of({"topic", "list", "--seconds", ""}), IsEmpty());
}

TEST_F(Completion, BehindTheLastArgumentComeTheOptions) {
  EXPECT_THAT(Of({"topic", "hz", "POSE", ""}), testing::IsSupersetOf({"--watch", "--seconds"}));
  EXPECT_THAT(Of({"topic", "hz", "POSE", ""}), Not(Contains("POSE")));
}

TEST_F(Completion, WithoutAWordEveryVerbIsOffered) {
  EXPECT_THAT(Of({}),
              testing::IsSupersetOf({"completion", "doctor", "log", "replay", "run", "topic", "type"}));
  EXPECT_EQ(Of({}), Of({""}));
}

TEST_F(Completion, FilesAreTheShells) {
  EXPECT_THAT(Of({"log", "info", ""}), IsEmpty());
  EXPECT_THAT(Of({"topic", "list", "--types", ""}), IsEmpty());
}

TEST_F(Completion, WhatIsUnknownHasNone) {
  EXPECT_THAT(Of({"nonsense"}), IsEmpty());
}

/// Every verb at any depth says how it is used.
void ExpectExamples(const CLI::App& app, const std::string& name, int& verbs) {
  const auto subs = app.get_subcommands([](const CLI::App*) { return true; });
  for (const auto* sub : subs)
    if (!sub->get_group().empty()) ExpectExamples(*sub, name + " " + sub->get_name(), verbs);
  if (!subs.empty()) return;
  ++verbs;
  EXPECT_THAT(app.get_footer(), testing::ContainsRegex("Examples?: priamos")) << name;
}

TEST_F(Completion, EveryVerbHasAnExample) {
  int verbs = 0;
  ExpectExamples(cli_, "priamos", verbs);
  EXPECT_GT(verbs, 15);
}

/// Whatever tells something tells it to programs, too.
TEST_F(Completion, EveryVerbThatLooksAtABusOrALogHasJson) {
  for (const std::string name : {"topic", "log", "type", "replay"})
    for (const auto* verb : cli_.get_subcommand(name)->get_subcommands([](const CLI::App*) { return true; }))
      EXPECT_NE(verb->get_option_no_throw("--json"), nullptr) << name << " " << verb->get_name();
  EXPECT_NE(cli_.get_subcommand("doctor")->get_option_no_throw("--json"), nullptr);
}

TEST(Shells, AskForWordsAndTakeTheScriptFromPriamos) {
  const std::pair<const char*, std::string> scripts[] = {
      {"bash", BashCompletion()}, {"zsh", ZshCompletion()}, {"fish", FishCompletion()}};
  for (const auto& [shell, script] : scripts) {
    EXPECT_THAT(script, testing::HasSubstr("completion words -- ")) << shell;
    const auto answer = Priamos({"completion", shell});
    EXPECT_EQ(answer.exit_code, 0) << shell;
    EXPECT_EQ(answer.out, script);
  }
}

TEST(Shells, AreAnsweredWithAWordPerLine) {
  EXPECT_EQ(Priamos({"completion", "words", "--", "log", "re"}).out, "record\nrepair\n");
  EXPECT_EQ(Priamos({"completion", "words", "--", "nonsense"}).out, "");
}

TEST(BashCompletion, AsksUs) {
  EXPECT_THAT(BashCompletion(), testing::HasSubstr("complete -o default -F _priamos priamos"));
}

}  // namespace
}  // namespace priamos::cli
