#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "lcmtypes/channels.hpp"
#include "test/cli/message_log.hpp"
#include "test/cli/priamos_answer.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

const std::string kLink = PRIAMOS_SOURCE_DIR "/config/sim/link.toml";

/// Channels whose load the line can carry, or cannot.
std::string LinkToml(double rate_hz) {
  return fmt::format(
      "baud = 9600\nsimulation_key = true\n[[channel]]\nname = \"POSE\"\ntype = \"pose_t\"\n"
      "direction = \"up\"\nclass = \"state\"\nrate_hz = {}\npriority = 3\n",
      rate_hz);
}

class LinkCommand : public testing::Test {
 protected:
  std::string Write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  TemporaryFolder folder_;
};

TEST_F(LinkCommand, BitsOfTheFieldsAddUpToThoseOfTheMessage) {
  for (const std::string type : {"estop_t", "pose_t", "drive_status_t"}) {
    const auto dut = json::parse(Priamos({"link", "bits", type, "--json"}).out);
    EXPECT_EQ(dut.at("type"), "priamos." + type);
    std::size_t sum = 0;
    for (const json& field : dut.at("fields")) sum += field.at("bits").get<std::size_t>();
    EXPECT_EQ(dut.at("max_bits"), sum) << "no field varies in number here: " << type;
  }
}

TEST_F(LinkCommand, AFieldTakesTheBitsThatItsRangeAndStepNeed) {
  for (const json& field : json::parse(Priamos({"link", "bits", "pose_t", "--json"}).out).at("fields")) {
    if (field.at("name") == "x_m") {
      EXPECT_EQ(field.at("bits"), 15) << "-100 to 100 by 0.01: 20001 values";
      EXPECT_EQ(field.at("unit"), "m");
    }
    if (field.at("name") == "rho_x_y") {
      EXPECT_EQ(field.at("bits"), 7) << "-1 to 1 by 0.02: 101 values";
    }
  }
}

TEST_F(LinkCommand, TheTableOfALinkHasItsHashAndEveryChannel) {
  const auto text = Priamos({"link", "table", kLink});
  EXPECT_EQ(text.exit_code, 0);
  EXPECT_THAT(text.out, StartsWith("priamos radio 1 table clear\n"));
  const auto dut = json::parse(Priamos({"link", "table", kLink, "--json"}).out);
  EXPECT_THAT(text.out, HasSubstr("\nhash " + dut.at("table_hash").get<std::string>()));
  const auto c = LinesOf(Priamos({"link", "table", kLink, "--c"}).out);
  ASSERT_EQ(c.size(), dut.at("channels").size());
  for (std::size_t i = 0; i < c.size(); ++i)
    EXPECT_THAT(c[i], StartsWith("{\"" + dut.at("channels")[i].at("name").get<std::string>() + "\", 0x"));
}

TEST_F(LinkCommand, ABudgetOfSeveralRobotsShowsTheirTurns) {
  const auto dut = json::parse(
      Priamos({"link", "budget", PRIAMOS_SOURCE_DIR "/modules/radio/tutorial/robots/link.toml", "--json"})
          .out);
  EXPECT_EQ(dut.at("polls").at("robots"), 2);
  EXPECT_LE(dut.at("polls").at("urgent_one_s"), 0.15);
  EXPECT_GT(dut.at("polls").at("urgent_all_s"), dut.at("polls").at("urgent_one_s"));
  EXPECT_EQ(dut.at("problems").size(), 0U);
}

TEST_F(LinkCommand, BitsForAPersonNameEveryField) {
  const auto answer = Priamos({"link", "bits", "estop_t"});
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_THAT(answer.out, AllOf(HasSubstr("utime"), HasSubstr("action"), HasSubstr("driver")));
  const auto lines = LinesOf(answer.out);
  EXPECT_THAT(lines.at(1), AllOf(StartsWith("utime "), HasSubstr(" nearest ")));
  EXPECT_THAT(lines.at(2), AllOf(StartsWith("action "), HasSubstr(" refused ")));
}

TEST_F(LinkCommand, BitsOfAnUnknownTypeAreRefusedWithTheNearest) {
  const auto answer = Priamos({"link", "bits", "pos_t"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("unknown type \"pos_t\"; nearest: \"pose_t\""));
}

TEST_F(LinkCommand, ATypeWithoutAnnotationsHasNoBits) {
  Write("their_t.lcm", "package their;\nstruct their_t {\n  double speed;\n}\n");
  const auto answer = Priamos({"link", "bits", "their_t", "--types", folder_.path()});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, AllOf(HasSubstr("their_t.lcm:3"), HasSubstr("speed")));
}

TEST_F(LinkCommand, TheShippedBudgetHoldsAndItsSharesAddUp) {
  const auto answer = Priamos({"link", "budget", kLink, "--json"});
  EXPECT_EQ(answer.exit_code, 0);
  const auto dut = json::parse(answer.out);
  EXPECT_TRUE(dut.at("problems").empty());
  for (const char* way : {"up", "down"}) {
    const json& direction = dut.at(way);
    double sum = direction.at("control_bytes_per_s");
    for (const json& channel : direction.at("channels")) {
      sum += channel.at("bytes_per_s").get<double>();
      if (channel.at("deadline_s").is_null()) continue;
      EXPECT_LE(channel.at("worst_latency_s"), channel.at("deadline_s")) << channel.at("channel");
    }
    EXPECT_NEAR(direction.at("bytes_per_s"), sum, 1e-6) << way;
    EXPECT_NEAR(
        direction.at("utilisation").get<double>() * direction.at("capacity_bytes_per_s").get<double>(), sum,
        1e-6);
  }
}

TEST_F(LinkCommand, ABudgetThatDoesNotHoldIsRefusedWithTheReason) {
  const std::string file = Write("link.toml", LinkToml(1000));
  const auto answer = Priamos({"link", "budget", file, "--json"});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err,
              StartsWith("priamos link budget: " + file + ":8:channel[0].rate_hz: radio link up: expected"));
  const auto dut = json::parse(answer.out);
  EXPECT_FALSE(dut.at("problems").empty());
  EXPECT_GT(dut.at("up").at("utilisation"), 1);
  EXPECT_EQ(dut.at("up").at("channels").at(0).at("deadline_s"), nullptr) << "none was asked for";
  EXPECT_EQ(Priamos({"link", "budget", Write("slow.toml", LinkToml(1))}).exit_code, 0);
}

TEST_F(LinkCommand, TheBudgetSaysHowLongForgeriesAreKeptOut) {
  const auto dut = json::parse(Priamos({"link", "budget", kLink, "--json"}).out);
  EXPECT_EQ(dut.at("code_bytes"), 4);
  EXPECT_NEAR(dut.at("forgery_s").get<double>() / 86400, 251, 1);
  const std::string longer = Write("link.toml", "code_bytes = 8\n" + LinkToml(1));
  EXPECT_EQ(json::parse(Priamos({"link", "budget", longer, "--json"}).out).at("code_bytes"), 8);
  EXPECT_THAT(Priamos({"link", "budget", longer}).out,
              AllOf(HasSubstr("codes of 8 bytes: of a line full of forged frames"),
                    HasSubstr("millions of years with 50 %")));
}

TEST_F(LinkCommand, CodesOfAnotherLengthAreRefused) {
  for (const int code_bytes : {1, 2, 3, 5, 7, 9}) {
    const std::string file = Write("link.toml", fmt::format("code_bytes = {}\n", code_bytes) + LinkToml(1));
    const auto answer = Priamos({"link", "budget", file});
    EXPECT_EQ(answer.exit_code, 2) << code_bytes;
    EXPECT_THAT(answer.err, AllOf(HasSubstr("link.toml:1"), HasSubstr("code_bytes"))) << code_bytes;
  }
}

TEST_F(LinkCommand, ALinkTomlThatIsWrongIsNamedWithLineAndKey) {
  const std::string file = Write("link.toml", "baud = 9600\nbauds = 3\n");
  const auto answer = Priamos({"link", "budget", file});
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, AllOf(HasSubstr("link.toml:2"), HasSubstr("bauds")));
  EXPECT_EQ(Priamos({"link", "budget", folder_ / "none.toml"}).exit_code, 2);
}

TEST_F(LinkCommand, ANewKeyIsForItsOwnerAloneAndNeverTwiceTheSame) {
  const std::string first = folder_ / "a.key", second = folder_ / "b.key";
  EXPECT_EQ(json::parse(Priamos({"link", "keygen", first, "--json"}).out), json({{"file", first}}));
  EXPECT_THAT(Priamos({"link", "keygen", second}).out, StartsWith(second + ": new key; copy it"));
  struct stat info {};
  ASSERT_EQ(stat(first.c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0600u);
  EXPECT_EQ(FileContent(first).size(), 65u) << "64 hexadecimal digits and a line feed";
  EXPECT_NE(FileContent(first), FileContent(second));
}

TEST_F(LinkCommand, ANextKeyIsMadeBesideTheKeyAndThenPutInItsPlace) {
  const std::string file = folder_ / "a.key";
  EXPECT_EQ(Priamos({"link", "rekey", file}).exit_code, 2) << "no key yet";
  Priamos({"link", "keygen", file});
  EXPECT_EQ(Priamos({"link", "rekey", "--finish", file}).exit_code, 2) << "no next key yet";
  EXPECT_THAT(Priamos({"link", "rekey", file}).out,
              AllOf(StartsWith(file + ".next: next key"), HasSubstr("priamos link rekey --finish " + file)));
  EXPECT_EQ(Priamos({"link", "rekey", file}).exit_code, 2) << "there is one";
  struct stat info {};
  ASSERT_EQ(stat((file + ".next").c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0600u);
  const std::string next = FileContent(file + ".next");
  EXPECT_NE(next, FileContent(file));
  EXPECT_EQ(json::parse(Priamos({"link", "rekey", "--finish", file, "--json"}).out), json({{"file", file}}));
  EXPECT_EQ(FileContent(file), next);
  EXPECT_NE(stat((file + ".next").c_str(), &info), 0);
}

TEST_F(LinkCommand, AKeyThatIsThereIsKept) {
  const std::string file = Write("a.key", "precious");
  EXPECT_EQ(Priamos({"link", "keygen", file}).exit_code, 2);
  EXPECT_EQ(FileContent(file), "precious");
}

TEST_F(LinkCommand, WhatAnEmulatedLineCannotBeIsRefused) {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"--baud", "299"},         {"--latency", "10.1"},          {"--bit-error-rate", "0.6"},
      {"--duplicate", "1.5"},    {"--burst-rate", "-1"},         {"--turnaround", "2"},
      {"--air-rate", "2000000"}, {"--burst-error-rate", "-0.1"}, {"--jitter", "nan"}};
  for (const auto& [option, value] : wrong) {
    const auto answer =
        Priamos({"link", "emulate", "--a", folder_ / "a", "--b", folder_ / "b", option, value});
    EXPECT_EQ(answer.exit_code, 2) << option;
    EXPECT_THAT(answer.err, AllOf(StartsWith("priamos link emulate: " + option + ": expected a"),
                                  HasSubstr("got \"" + value + "\"")));
  }
}

TEST_F(LinkCommand, OptionsOfAnEmulatedLineWithoutEffectAreRefused) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong{
      {{"--turnaround", "0.1"}, "--turnaround: expected none without --half-duplex"},
      {{"--burst-length", "1"}, "--burst-length: expected none without --burst-rate"},
      {{"--burst-error-rate", "0.1"}, "--burst-error-rate: expected none without --burst-rate"},
      {{"--packets", "--air-rate", "500", "--baud", "1200"}, "--baud: expected none with --packets"},
      {{"--packets", "--air-rate", "500", "--delays", "x"}, "--delays: expected none with --packets"},
      {{"--b", folder_ / "a"}, "--b: expected another name than that of --a"},
      {{"--seed", "1", "--seed", "2"}, "--seed"}};
  for (const auto& [options, sentence] : wrong) {
    std::vector<std::string> words{"link", "emulate", "--a", folder_ / "a"};
    words.insert(words.end(), options.begin(), options.end());
    const auto answer = Priamos(words);
    EXPECT_EQ(answer.exit_code, 2) << sentence;
    EXPECT_THAT(answer.err, StartsWith("priamos link emulate: " + sentence));
    EXPECT_EQ(std::count(answer.err.begin(), answer.err.end(), '\n'), 1) << answer.err;
  }
}

TEST_F(LinkCommand, NoTableIsPrintedOfALinkThatDoesNotHold) {
  const std::string file =
      Write("link.toml",
            "simulation_key = true\n[[channel]]\nname = \"POSE\"\ntype = \"pose_t\"\ndirection = \"up\"\n"
            "class = \"state\"\nrate_hz = 4\ndeadline_s = 0.01\n");
  for (const char* form : {"--json", "--c"}) {
    const auto answer = Priamos({"link", "table", file, form});
    EXPECT_EQ(answer.exit_code, 2) << form;
    EXPECT_EQ(answer.out, "");
    EXPECT_THAT(answer.err, HasSubstr(file + ":8:channel[0].deadline_s: radio channel POSE: expected"));
  }
}

TEST_F(LinkCommand, TopAndListenSayForHowLong) {
  for (const char* seconds : {"-1", "86401"}) {
    const auto answer = Priamos({"link", "listen", "SONAR_RANGES", "--for", seconds, "--bus", "memq://"});
    EXPECT_EQ(answer.exit_code, 2) << seconds;
    EXPECT_THAT(answer.err, HasSubstr("--for: expected a number, 0 to 86400"));
  }
}

class LinkOnABus : public LinkCommand {
 protected:
  LinkOnABus() {
    for (int i = 0; i < 40; ++i) Report(0.1 * i, 10 + i);
  }
  void Report(double t_s, int messages) {
    link_status_t report{};
    report.up = report.onboard = true;
    report.all_channels = report.n_channels = 1;
    link_channel_t channel{};
    channel.channel = "POSE";
    channel.outgoing = true;
    channel.messages = messages;
    report.channels = {channel};
    log_.Add(t_s, "LINK_STATUS", report);
  }
  MessageLog log_{folder_ / "bus.lcmlog"};
};

TEST_F(LinkOnABus, TopOnceEndsWhenTheRatesAreKnown) {
  const auto answer = Priamos({"link", "top", "--once", "--json", "--bus", log_.url()});
  EXPECT_EQ(answer.exit_code, 0);
  const auto lines = LinesOf(answer.out);
  ASSERT_EQ(lines.size(), 1u);
  const auto dut = json::parse(lines[0]);
  EXPECT_TRUE(dut.at("heard"));
  EXPECT_EQ(dut.at("channels").at(0).at("channel"), "POSE");
  EXPECT_TRUE(dut.at("channels").at(0).at("messages_per_s").is_number());
}

TEST_F(LinkOnABus, TopOnceForAPersonIsAScreen) {
  EXPECT_THAT(Priamos({"link", "top", "--once", "--bus", log_.url()}).out,
              StartsWith("radio link, onboard end: up\n"));
}

}  // namespace
}  // namespace priamos::cli
