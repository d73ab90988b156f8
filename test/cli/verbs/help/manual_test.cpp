#include "cli/verbs/help/manual.hpp"

#include <gmock/gmock.h>

#include <CLI/CLI.hpp>

#include "common/config_keys.hpp"

namespace priamos::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

const ManualIssue kIssue{"2026-01-31", "priamos 9.9"};

TEST(ManualPage, WhatTroffWouldTakeForACommandIsText) {
  ManualPage page("priamos-x", 1, "does \\ and -", kIssue);
  page.Paragraph(".TH is text\n'so is this");
  page.Section("a \"quote\"");
  EXPECT_THAT(page.Text(), HasSubstr(".TH \"PRIAMOS\\-X\" 1 \"2026-01-31\" \"priamos 9.9\" \"PRIAMOS\"\n"));
  EXPECT_THAT(page.Text(), HasSubstr("priamos\\-x \\- does \\e and \\-\n"));
  EXPECT_THAT(page.Text(), HasSubstr("\\&.TH is text\n\\&'so is this\n"));
  EXPECT_THAT(page.Text(), HasSubstr(".SH \"a \"\"quote\"\"\"\n"));
  EXPECT_EQ(page.FileName(), "priamos-x.1");
}

struct Sample {
  double speed_m_s = 1;
  std::string mode = "slow";
  struct Item {
    int count = 2;
    void Describe(Archive& a) { a.Integer("count", count, {"-", 0, 9, "how many"}); }
  };
  std::vector<Item> items;
  Item inner;
  void Describe(Archive& a) {
    a.Number("speed_m_s", speed_m_s, {"m/s", 0, 1.5, "limit"});
    a.Choice("mode", mode, {"slow", "fast"}, "which");
    a.List("item", items, "things");
    a.Section("inner", inner, "one thing");
  }
};

TEST(ConfigKeys, HaveTheirSectionUnitDefaultAndRange) {
  std::vector<std::string> all;
  for (const auto& key : KeysOf<Sample>()) all.push_back(key.name + "|" + key.value + "|" + key.meaning);
  EXPECT_THAT(
      all, testing::ElementsAre("speed_m_s|1|[m/s] limit; 0 to 1.5", "mode|\"slow\"|which; one of slow, fast",
                                "item[]||things", "item[].count|2|[-] how many; 0 to 9", "inner||one thing",
                                "inner.count|2|[-] how many; 0 to 9"));
}

class ManualOfAProgram : public testing::Test {
 protected:
  ManualOfAProgram() {
    auto* verb = cli_.add_subcommand("greet", "Say hello.");
    verb->add_option("name", name_, "to whom")->required();
    verb->add_flag("--loud", loud_, "so that all hear it");
    verb->footer("Example: priamos greet you");
    auto* outer = cli_.add_subcommand("topic", "Channels.");
    outer->add_subcommand("list", "All of them.");
    cli_.add_subcommand("secret", "For the build.")->group("");
  }
  std::string Page(const std::string& name) {
    for (const auto& page : Manual(cli_, kIssue))
      if (page.FileName() == name) return page.Text();
    return "no page";
  }
  CLI::App cli_{"The program.", "priamos"};
  std::string name_;
  bool loud_ = false;
};

TEST_F(ManualOfAProgram, AVerbHasItsOptionsArgumentsAndExample) {
  const std::string page = Page("priamos-greet.1");
  EXPECT_THAT(page, HasSubstr("priamos\\-greet \\- Say hello\n"));
  EXPECT_THAT(page, HasSubstr("priamos greet [OPTION...] name\n"));
  EXPECT_THAT(page, HasSubstr("\\fB\\-\\-loud\\fR\nso that all hear it\n"));
  EXPECT_THAT(page, HasSubstr("\\fBname\\fR TEXT REQUIRED\nto whom\n"));
  EXPECT_THAT(page, HasSubstr("Example: priamos greet you\n"));
}

TEST_F(ManualOfAProgram, VerbsOfAVerbAreOnItsPageAndHiddenOnesOnNone) {
  EXPECT_THAT(Page("priamos-topic.1"), HasSubstr(".SS \"priamos topic list [OPTION...]\"\nAll of them.\n"));
  EXPECT_EQ(Page("priamos-secret.1"), "no page");
  EXPECT_THAT(Page("priamos.1"), HasSubstr(".BR priamos\\-greet (1),\n"));
  EXPECT_THAT(Page("priamos.1"), Not(HasSubstr("secret")));
}

TEST_F(ManualOfAProgram, AProcessHasItsOptionsAndEveryKeyWithItsUnit) {
  const std::string page = Page("priamos-robot.1");
  EXPECT_THAT(page, HasSubstr("\\fB\\-\\-print\\-config\\fR\n"));
  EXPECT_THAT(page, HasSubstr("\\fBbase.wheel_radius_m\\fR = "));
  EXPECT_THAT(page, HasSubstr("[m] "));
  EXPECT_THAT(Page("priamos-deployment.5"), HasSubstr("\\fBprocess[].module\\fR = "));
}

}  // namespace
}  // namespace priamos::cli
