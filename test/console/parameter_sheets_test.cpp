#include "console/parameter_sheets.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "test/support/temporary_folder.hpp"

namespace priamos::console {
namespace {

using testing::HasSubstr;

/// Two programs that print something, and a deployment in a folder with an awkward name.
class ParameterSheetsTest : public testing::Test {
 protected:
  ParameterSheetsTest() {
    std::filesystem::create_directories(Config());
    const std::string live = bus::ToJson(
        {ParameterTable(std::vector<Parameter>{{"gap_m", "m", "gap", 0, 1, LiveChange::kInRange}}), {0.5}});
    Program("priamos-robot",
            "[ $3 = --print-parameters ] && echo '" + live +
                "' && exit; echo 'speed_m_s = 0.3   # [m/s] at most; 0 to 1.5'; echo \"# $2\"");
    Program("priamos-head", "echo 'head.toml:3: zoom: expected a number' >&2; exit 2");
    for (const char* file : {"robot.toml", "head.toml", "link.toml", "notes.txt"})
      std::ofstream(Config() / file) << "\n";
  }
  void Program(const std::string& name, const std::string& script) {
    std::ofstream(folder_ / name) << "#!/bin/sh\n" << script << "\n";
    std::filesystem::permissions(folder_ / name, std::filesystem::perms::owner_all);
  }
  std::filesystem::path Programs() const { return std::filesystem::path(folder_ / ""); }
  std::filesystem::path Config() const { return folder_ / "it's $(touch x)"; }

  TemporaryFolder folder_;
};

TEST_F(ParameterSheetsTest, EveryProcessThatHasAFileIsAsked) {
  const auto dut = AskForParameters(Programs(), Config());
  ASSERT_EQ(dut.size(), 2u) << "link.toml is nobody's configuration";
  EXPECT_THAT(dut.at("robot").text, HasSubstr("speed_m_s = 0.3"));
  EXPECT_THAT(dut.at("robot").text, HasSubstr((Config() / "robot.toml").string()));
  EXPECT_EQ(dut.at("head").text, "# head.toml:3: zoom: expected a number\n") << "why it has none";
  ASSERT_TRUE(dut.at("robot").live);
  EXPECT_EQ(dut.at("robot").live->table.NumberOf("gap_m"), 1);
  EXPECT_EQ(dut.at("robot").live->values.at(0), 0.5);
  EXPECT_FALSE(dut.at("head").live);
  EXPECT_TRUE(AskForParameters(Programs(), folder_ / "nowhere").empty());
}

TEST_F(ParameterSheetsTest, TheyAreAskedOnceAndAnswerOnce) {
  ParameterQuestion dut;
  EXPECT_FALSE(dut.Take());
  dut.Ask(Programs(), Config());
  dut.Ask(Programs(), Config());
  std::optional<ParameterSheets> answer;
  while (!answer) answer = dut.Take();
  EXPECT_EQ(answer->size(), 2u);
  EXPECT_FALSE(dut.Take());
}

}  // namespace
}  // namespace priamos::console
