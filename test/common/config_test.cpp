#include "common/config.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "common/config_printer.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

struct Item {
  double size_m = 1;
  void Describe(Archive& a) { a.Number("size_m", size_m, {"m", 0, 10, "its size"}); }
};

struct Inner {
  std::string word = "left";
  std::vector<double> gains{1, 2};
  void Describe(Archive& a) {
    a.Choice("word", word, {"left", "right"}, "a side");
    a.Numbers("gains", gains, {"-", 0, 5, "two gains"});
  }
};

struct Outer {
  double speed_m_s = 0.5;
  int count = 3;
  bool on = false;
  std::string name = "none";
  Inner inner;
  std::vector<Item> items;
  void Describe(Archive& a) {
    a.Number("speed_m_s", speed_m_s, {"m/s", 0, 1.5, "a speed"});
    a.Integer("count", count, {"-", 0, 9, "a count"});
    a.Flag("on", on, "a flag");
    a.Text("name", name, "a name");
    a.Section("inner", inner, "an inner thing");
    a.List("item", items, "things");
  }
};

std::string ErrorOf(const std::string& text) {
  try {
    ParseConfig<Outer>("x.toml", text);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Config, AbsentKeysKeepTheirDefaults) {
  const auto dut = ParseConfig<Outer>("x.toml", "count = 4\n");
  EXPECT_EQ(dut.count, 4);
  EXPECT_EQ(dut.speed_m_s, 0.5);
  EXPECT_EQ(dut.inner.word, "left");
}

TEST(Config, ReadsSectionsAndLists) {
  const auto dut =
      ParseConfig<Outer>("x.toml",
                         "speed_m_s = 1\non = true\nname = 'n'\n[inner]\nword = 'right'\ngains = [3, 4.5]\n"
                         "[[item]]\nsize_m = 2\n[[item]]\nsize_m = 3\n");
  EXPECT_EQ(dut.speed_m_s, 1);
  EXPECT_TRUE(dut.on);
  EXPECT_EQ(dut.inner.gains, (std::vector<double>{3, 4.5}));
  ASSERT_EQ(dut.items.size(), 2u);
  EXPECT_EQ(dut.items[1].size_m, 3);
}

TEST(Config, ErrorNamesFileLineKeyExpectationAndValue) {
  EXPECT_EQ(ErrorOf("\nspeed_m_s = 2.5\n"), "x.toml:2:speed_m_s: expected a number, 0 to 1.5 [m/s], got 2.5");
  EXPECT_EQ(ErrorOf("count = 1.5"), "x.toml:1:count: expected a whole number, 0 to 9 [-], got 1.5");
  EXPECT_EQ(ErrorOf("on = 1"), "x.toml:1:on: expected true or false, got 1");
  EXPECT_EQ(ErrorOf("[inner]\nword = 'up'"), "x.toml:2:inner.word: expected one of left, right, got \"up\"");
  EXPECT_EQ(ErrorOf("[inner]\ngains = [1]"), "x.toml:2:inner.gains: expected 2 numbers, got an array of 1");
}

TEST(Config, NotANumberIsRefused) {
  EXPECT_THAT(ErrorOf("speed_m_s = nan"), HasSubstr("expected a number"));
}

TEST(Config, UnknownKeyIsRefusedAtEveryLevel) {
  EXPECT_THAT(ErrorOf("spede_m_s = 1"), HasSubstr("x.toml:1:spede_m_s: expected a known key"));
  EXPECT_THAT(ErrorOf("[inner]\nwrod = 1"), HasSubstr("x.toml:2:inner.wrod"));
  EXPECT_THAT(ErrorOf("[[item]]\nsize_m = 1\n[[item]]\nweight = 1"), HasSubstr("x.toml:4:item[1].weight"));
}

TEST(Config, BrokenTomlNamesTheLine) {
  EXPECT_THAT(ErrorOf("count = 1\ncount ="), HasSubstr("x.toml:2: expected TOML"));
}

TEST(Config, AKeyOfThousandsOfPartsIsRefused) {
  std::string deep = "a";
  for (int i = 0; i < 40'000; ++i) deep += ".a";
  for (const std::string& line : {"[" + deep + "]", deep + " = 1"})
    EXPECT_THAT(ErrorOf("\n" + line + "\n"), HasSubstr(":2: expected a key of at most 32 parts"));
}

TEST(Config, MissingFileIsNamed) {
  try {
    LoadConfig<Outer>("/nowhere/x.toml");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("/nowhere/x.toml: expected a configuration file, got none"));
  }
}

TEST(Config, OverridesGoOnTopOfTheFileAndMayBeBareWords) {
  const auto dut = LoadConfig<Outer>(ConfigSource{"", {"count = 7", "name=/dev/ttyS0", "inner.word=right"}});
  EXPECT_EQ(dut.count, 7);
  EXPECT_EQ(dut.name, "/dev/ttyS0");
  EXPECT_EQ(dut.inner.word, "right");
}

std::string OverrideErrorOf(const std::string& text) {
  try {
    LoadConfig<Outer>(ConfigSource{"", {text}});
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Config, ABadOverrideIsBlamedOnItself) {
  EXPECT_THAT(OverrideErrorOf("count=99"), HasSubstr("--set count=99: count: expected a whole number"));
  EXPECT_EQ(OverrideErrorOf("count"), "--set count: expected KEY=VALUE");
  EXPECT_EQ(OverrideErrorOf(""), "--set \"\": expected KEY=VALUE") << "of a variable that is not set";
  EXPECT_EQ(OverrideErrorOf("inner.word=lft"),
            "--set inner.word=lft: inner.word: expected one of left, right, got \"lft\"; nearest: \"left\"");
}

TEST(Config, AnUnknownOverrideIsNotBlamedOnTheFile) {
  const TemporaryFolder folder;
  const std::string file = folder / "x.toml";
  std::ofstream(file) << "[inner]\nword = 'left'\n";
  try {
    LoadConfig<Outer>(ConfigSource{file, {"inner.wrod=right"}});
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), StartsWith("--set inner.wrod=right: inner.wrod: expected a known key"));
    EXPECT_THAT(error.what(), HasSubstr("; nearest: \"inner.word\""));
  }
}

TEST(Config, AnUnknownKeyIsAnsweredWithTheNearestOne) {
  EXPECT_THAT(ErrorOf("sped_m_s = 1"), HasSubstr("; nearest: \"speed_m_s\""));
  EXPECT_THAT(ErrorOf("[inner]\nwrod = 1"), HasSubstr("; nearest: \"inner.word\""));
  EXPECT_THAT(ErrorOf("[iner]\nword = 1"), HasSubstr("; nearest: \"inner\""));
  EXPECT_THAT(ErrorOf("word = 'left'"), HasSubstr("; nearest: \"inner.word\""))
      << "right name, wrong section";
  EXPECT_THAT(ErrorOf("gians = [1, 2]"), HasSubstr("; nearest: \"inner.gains\""))
      << "nearly the name, wrong section";
  EXPECT_THAT(ErrorOf("[speed]\nwrod = 'left'"),
              AllOf(StartsWith("x.toml:2:speed.wrod:"), HasSubstr("; nearest: \"inner.word\"")))
      << "nearly the name, no such section";
  EXPECT_THAT(ErrorOf("elephant = 1"), Not(HasSubstr("nearest")));
}

TEST(Config, AMissingFileIsAnsweredWithTheNearestOne) {
  const TemporaryFolder folder;
  std::ofstream(folder / "robot.toml") << "";
  try {
    LoadConfig<Outer>(folder / "robto.toml");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr(fmt::format("robto.toml: expected a configuration file, got none; nearest: \"{}\"",
                                      (folder / "robot.toml").string())));
  }
}

TEST(Config, PrintedConfigurationLoadsToTheSameValues) {
  Outer original;
  original.speed_m_s = 0.1 + 0.2;
  original.inner.gains = {1e-3, 5};
  original.items = {{2}, {3.5}};
  std::ostringstream out;
  PrintConfig(out, original);
  const auto dut = ParseConfig<Outer>("printed", out.str());
  EXPECT_EQ(dut.speed_m_s, original.speed_m_s);
  EXPECT_EQ(dut.inner.gains, original.inner.gains);
  ASSERT_EQ(dut.items.size(), 2u);
  EXPECT_EQ(dut.items[1].size_m, 3.5);
  EXPECT_THAT(out.str(), HasSubstr("[m/s] a speed; 0 to 1.5"));
}

}  // namespace
}  // namespace priamos
