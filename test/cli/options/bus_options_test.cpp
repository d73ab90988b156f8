#include "cli/options/bus_options.hpp"

#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <fstream>

#include "bus/own_types.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using testing::HasSubstr;

class BusOptionsTest : public testing::Test {
 protected:
  BusOptionsTest() {
    for (const char* variable : {"PRIAMOS_BUS", "PRIAMOS_ROBOT", "PRIAMOS_TTL", "PRIAMOS_NETWORK"})
      unsetenv(variable);
    AddBusOption(verb_, options_);
    AddTypesOption(verb_, options_.types);
  }
  void Parse(std::vector<std::string> words) {
    std::reverse(words.begin(), words.end());
    verb_.parse(words);
  }
  CLI::App verb_;
  BusOptions options_;
};

TEST_F(BusOptionsTest, TheDefaultIsTheOffboardBusOfOneHost) {
  Parse({});
  EXPECT_EQ(options_.bus.bus, "offboard");
  EXPECT_EQ(options_.bus.ttl, 0);
  EXPECT_EQ(options_.messages(), bus::LcmBus::Messages::kParametric);
}

TEST_F(BusOptionsTest, TheEnvironmentIsTheDefaultAndTheWordWins) {
  setenv("PRIAMOS_BUS", "onboard", 1);
  setenv("PRIAMOS_ROBOT", "hektor", 1);
  Parse({"--robot", "paris"});
  unsetenv("PRIAMOS_BUS");
  unsetenv("PRIAMOS_ROBOT");
  EXPECT_EQ(options_.bus.bus, "onboard");
  EXPECT_EQ(options_.bus.robot, "paris");
}

TEST_F(BusOptionsTest, FragmentsAllowMessagesOfAnySize) {
  Parse({"--fragments"});
  EXPECT_EQ(options_.messages(), bus::LcmBus::Messages::kAnySize);
}

TEST_F(BusOptionsTest, ATtlIsAByte) {
  EXPECT_THROW(Parse({"--ttl", "-1"}), CLI::ValidationError);
  EXPECT_THROW(Parse({"--ttl", "256"}), CLI::ValidationError);
  EXPECT_NO_THROW(Parse({"--ttl", "255"}));
}

TEST_F(BusOptionsTest, TypesAreAFolderThatIsThere) {
  EXPECT_THROW(Parse({"--types", "/no/such/folder"}), CLI::ValidationError);
}

TEST_F(BusOptionsTest, TypesMayBeSeveralFoldersAndLeaveTheOtherWordsAlone) {
  std::string channel;
  AddChannelArgument(verb_, channel);
  Parse({"--types", "/", "--types", "/tmp", "POSE"});
  EXPECT_EQ(options_.types, (std::vector<std::string>{"/", "/tmp"}));
  EXPECT_EQ(channel, "POSE");
}

TEST_F(BusOptionsTest, AChannelIsWanted) {
  std::string channel;
  AddChannelArgument(verb_, channel);
  EXPECT_THROW(Parse({}), CLI::RequiredError);
  Parse({"POSE"});
  EXPECT_EQ(channel, "POSE");
}

TEST(LoadTypes, WithoutAFolderTheyAreOurOwn) {
  EXPECT_EQ(LoadTypes({}).All().size(), bus::OwnTypes().All().size());
}

TEST(LoadTypes, FromAFolderTheyAreThoseAlone) {
  TemporaryFolder folder;
  std::ofstream(folder / "a_t.lcm") << "package a;\nstruct a_t {\n  int32_t n;\n}\n";
  BusOptions options;
  options.types = {folder.path()};
  const bus::Schema dut = LoadTypes(options.types);
  ASSERT_EQ(dut.All().size(), 1u);
  EXPECT_EQ(dut.All()[0]->full_name, "a.a_t");
}

TEST(UnknownType, NamesTheNearestInTheFormThatWasAsked) {
  const bus::Schema schema = bus::OwnTypes();
  EXPECT_THAT(UnknownType(schema, "poze_t").what(), HasSubstr("; nearest: \"pose_t\" ("));
  EXPECT_THAT(UnknownType(schema, "priamos.poze_t").what(), HasSubstr("; nearest: \"priamos.pose_t\" ("));
  EXPECT_STREQ(UnknownType(schema, "zzzzzzzzzzzz").what(),
               "unknown type \"zzzzzzzzzzzz\" (priamos type hash lists all)");
}

}  // namespace
}  // namespace priamos::cli
