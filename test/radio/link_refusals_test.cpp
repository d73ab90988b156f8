#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "bus/own_types.hpp"
#include "bus/radio/budget.hpp"
#include "bus/radio/link_config.hpp"
#include "common/config.hpp"
#include "common/config_keys.hpp"
#include "test/support/thrown_reason.hpp"

// Every refusal of a link.toml, and of its budget, says where (file:line:key), what was expected and what it
// got.

namespace priamos::radio {
namespace {

using bus::radio::LinkConfig;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::StartsWith;

const char* const kTypes =
    "package yours;\n"
    "struct text_t {\n  string text;  // [ascii] @max 20: words\n}\n"
    "struct long_t {\n  string text;  // [ascii] @max 600: words\n}\n"
    "struct longest_t {\n  string text;  // [ascii] @max 3000: words\n}\n"
    "struct bare_t {\n  double speed;\n}\n";

/// Why a link.toml cannot be used: of its reading the one reason, of its budget all.
std::vector<std::string> RefusalsOf(const std::string& toml) {
  static const bus::Schema types = bus::OwnTypes({{"yours.lcm", kTypes}});
  std::vector<std::string> refusals;
  const std::string thrown = support::ThrownReason([&] {
    const auto link = ParseConfig<LinkConfig>("link.toml", toml);
    refusals = ComputeBudget(link.Table(types), link.Options()).problems;
  });
  if (!thrown.empty()) refusals = {thrown};
  return refusals;
}

/// The form of each refusal. No control character: a terminal may obey it.
const char* const kForm =
    R"(link\.toml:[0-9]+:[a-z_]+(\[[0-9]+\]\.[a-z_]+)?: (radio (link (up|down)|channel [!-~]+): )?expected [^[:cntrl:]]+, got [^[:cntrl:]]+)";

/// A link.toml that is refused. The line that must be named ends with `#!`; what is expected of which key.
struct Case {
  std::string toml, key, expected;
};

/// A channel with some more keys, one a line.
std::string Channel(const std::string& name, const std::string& type, const std::string& direction,
                    const std::string& channel_class, const std::string& more) {
  return fmt::format("[[channel]]\nname = \"{}\"\ntype = \"{}\"\ndirection = \"{}\"\nclass = \"{}\"\n{}\n",
                     name, type, direction, channel_class, more);
}

/// A link that holds, with other keys for the line and the channel POSE.
std::string Link(const std::string& line, const std::string& pose = "") {
  return fmt::format("simulation_key = true\n{}\n{}", line, Channel("POSE", "pose_t", "up", "state", pose));
}

std::string LinkWith(const std::string& line, const std::string& channels) {
  return fmt::format("simulation_key = true\n{}\n{}", line, channels);
}

std::vector<Case> LineCases() {
  return {
      {Link("half_duplex_turn_s = 0.1 #!"), "half_duplex_turn_s",
       "0, or time for at least two frames of max_bundle_bytes, 0.267 s"},
      {"medium = \"packet\" #!\n" + Link(""), "packet_overhead_s", "more than 0 with medium"},
      {Link("medium = \"packet\"\npacket_overhead_s = 0.02\ndatagrams = true #!"), "datagrams",
       "false: with medium \"packet\" a frame"},
      {Link("packet_overhead_s = 0.02 #!"), "packet_overhead_s", "0, other than with medium"},
      {Link("duty_cycle = 0.1 #!"), "duty_cycle", "1, other than with medium"},
      {Link("medium = \"packet\"\npacket_overhead_s = 0.02\nhalf_duplex_turn_s = 1\nduty_cycle = 0.1 #!"),
       "duty_cycle", "1 with half_duplex_turn_s"},
      {Link("max_bundle_bytes = 29 #!"), "max_bundle_bytes", "30 or more on a link of two ends"},
      {Link("datagrams = true\nrobots = 2 #!"), "robots", "0 with datagrams or packets"},
      {Link("robots = 2\nhalf_duplex_turn_s = 1 #!"), "half_duplex_turn_s", "0 with robots"},
      {Link("keep_alive_s = 2\nsilence_s = 2 #!"), "silence_s", "more than keep_alive_s"},
      {Link("code_bytes = 5 #!"), "code_bytes", "4, 6, 8, or 0 for the default"},
      {Link("mtu_bytes = 100 #!"), "mtu_bytes", "none, other than with medium"},
      {Link("duty_window_s = 60 #!"), "duty_window_s", "none without a duty_cycle below 1"},
      {Link("grace_s = 0.01 #!"), "grace_s", "none without robots"},
      {Link("turnaround_s = 0.1 #!"), "turnaround_s", "none without half_duplex_turn_s or robots"},
      {Link("air_rate_bytes_s = 961 #!"), "air_rate_bytes_s", "0, or at most the rate of the port"},
      {Link("key_file = \"mine.key\" #!"), "key_file", "none beside simulation_key"},
      {"key_file = \"\" #!\n" + Channel("POSE", "pose_t", "up", "state", ""), "key_file",
       "the name of a key"},
      {"key_file = \"a\\u0000b\" #!\n" + Channel("POSE", "pose_t", "up", "state", ""), "key_file",
       "the name of a key"},
      {Link("datagrams = true", "fresh_s = 0.3 #!"), "channel[0].fresh_s", "0, other than on a line of two"},
      {Link("baud = 115200\nahead_bytes = 5 #!"), "ahead_bytes", "at least 18 at this rate"},
      {"simulation_key = true #!\n", "channel", "1 to 62 [[channel]] tables"},
  };
}

std::vector<Case> ChannelCases() {
  const std::string two =
      Channel("POSE", "pose_t", "up", "state", "") + Channel("POSE", "pose_t", "up", "state", "");
  std::string twice = two;
  twice.insert(twice.find('\n', twice.rfind("name =")), " #!");
  const auto of_type = [](const std::string& type, const std::string& channel_class) {
    return LinkWith(
        "", fmt::format("[[channel]]\nname = \"A\"\ntype = \"{}\" #!\ndirection = \"up\"\nclass = \"{}\"\n"
                        "ttl_s = {}\n",
                        type, channel_class, channel_class == "command" ? 1 : 0));
  };
  return {
      {"[[channel]] #!\nname = \"A\"\nclass = \"state\"\n", "channel[0].direction", "up or down"},
      {"[[channel]] #!\nname = \"A\"\ndirection = \"up\"\n", "channel[0].class", "state, event or command"},
      {"[[channel]]\ndirection = \"up\"\nclass = \"state\"\nname = \"A\\n\" #!", "channel[0].name",
       "the name of an LCM channel"},
      {LinkWith("", Channel("A", "pose_t", "up", "command", "ttl_s = 0 #!")), "channel[0].ttl_s",
       "a time-to-live of at least 0.001"},
      {Link("", "ttl_s = 1e-9 #!"), "channel[0].ttl_s", "0 for no limit, or at least 0.001"},
      {Link("", "fresh_s = 1e-9 #!"), "channel[0].fresh_s", "0 for no bound, or at least 0.001"},
      {LinkWith("", Channel("A", "pose_t", "up", "event", "fresh_s = 0.3 #!")), "channel[0].fresh_s",
       "0: a bound is for a channel of class state"},
      {LinkWith("", Channel("A", "pose_t", "up", "state", "fresh_s = 0.3") +
                        Channel("B", "pose_t", "up", "state", "fresh_s = 0.3 #!")),
       "channel[1].fresh_s", "0 beside A"},
      {Link("", "fresh_s = 0.2 #!"), "channel[0].fresh_s", "a fresh_s of at least"},
      {Link("", "deadline_s = 1e-9 #!"), "channel[0].deadline_s", "0 for any, or at least 0.001"},
      {LinkWith("", Channel("A", "pose_t", "up", "event", "ttl_s = 1 #!")), "channel[0].ttl_s",
       "none: an event is delivered"},
      {LinkWith("", Channel("A", "pose_t", "up", "event", "delta = true #!")), "channel[0].delta",
       "false: differences are for channels of class state"},
      {LinkWith("", Channel("A", "health_t", "up", "event", "key = \"process\" #!")), "channel[0].key",
       "none: keys are for channels of class state"},
      {Link("", "keys = 2 #!"), "channel[0].keys", "1 without a key"},
      {of_type("A\\u001bB_t", "state"), "channel[0].type", "the name of a known .lcm type"},
      {Link("", "key = \"x_m\" #!"), "channel[0].key", "a text field of priamos.pose_t"},
      {LinkWith("", Channel("A", "text_t", "up", "state", "delta = true #!")), "channel[0].delta",
       "false with yours.text_t, whose messages differ in size"},
      {of_type("bare_t", "state"), "channel[0].type", "a type that can be packed"},
      {of_type("longest_t", "event"), "channel[0].type", "an event of at most 1400 bytes"},
      {LinkWith("",
                "[[channel]]\nname = \"A\"\ntype = \"long_t\"\ndirection = \"up\"\nclass = \"state\" #!\n"),
       "channel[0].class", "\"event\" for messages of"},
      {LinkWith("", twice), "channel[1].name", "a channel once in a direction"},
  };
}

std::vector<Case> BudgetCases() {
  const std::string drive = "rate_hz = 5\nttl_s = ";
  const auto packets = [](const std::string& more, const std::string& channels) {
    return LinkWith("air_rate_bytes_s = 684\nmedium = \"packet\"\npacket_overhead_s = 0.06\n" + more,
                    channels);
  };
  const std::string pose = Channel("POSE", "pose_t", "up", "state", "rate_hz = 0.05");
  return {
      {Link("", "rate_hz = 100 #!"), "channel[0].rate_hz", "at most 960 byte/s"},
      {LinkWith("baud = 300 #!\nline_delay_s = 2",
                Channel("STOP", "estop_t", "up", "event", "rate_hz = 200\nurgent = true")),
       "baud", "at most"},
      {Link("", "deadline_s = 0.01 #!"), "channel[0].deadline_s", "delivery within its deadline_s of 0.01 s"},
      {Link("", "ttl_s = 0.01 #!"), "channel[0].ttl_s", "a ttl_s of at least"},
      {LinkWith("", Channel("A", "pose_t", "up", "state", "rate_hz = 50\npriority = 0") +
                        Channel("B", "health_t", "up", "state", "priority = 5\nttl_s = 9 #!")),
       "channel[1].ttl_s", "no ttl_s where nothing bounds"},
      {LinkWith("", Channel("DRIVE", "drive_command_t", "down", "command", drive + "0.1 #!")),
       "channel[0].ttl_s", "a ttl_s of at least"},
      {LinkWith("line_delay_s = 60 #!",
                Channel("DRIVE", "drive_command_t", "down", "command", drive + "100")),
       "line_delay_s", "a line_delay_s and a silence of the other end of at most"},
      {packets("duty_window_s = 1\nduty_cycle = 0.01 #!", pose), "duty_cycle", "packets of at most"},
      {packets(
           "duty_window_s = 60\nduty_cycle = 0.02 #!",
           pose + Channel("STOP", "estop_t", "down", "event", "rate_hz = 0.001\nburst = 64\nurgent = true")),
       "duty_cycle", "urgent messages that take at most"},
      {packets("duty_cycle = 0.01\nsilence_s = 1.5 #!", pose), "silence_s", "at least"},
      {Link("baud = 1200\nkeep_alive_s = 0.05\nsilence_s = 0.3 #!"), "silence_s", "at least 1."},
      {Link("half_duplex_turn_s = 1\nsilence_s = 1 #!"), "silence_s", "at least 1."},
      {LinkWith("baud = 57600\nrobots = 8\nsilence_s = 0.3 #!", Channel("POSE", "pose_t", "up", "state", "")),
       "silence_s", "at least 2."},
      {packets("mtu_bytes = 60 #!", pose), "mtu_bytes", "frames of at most 60 byte"},
      {LinkWith("robots = 2\nmax_bundle_bytes = 16 #!", Channel("POSE", "pose_t", "up", "state", "")),
       "max_bundle_bytes", "a max_bundle_bytes of at least"},
  };
}

std::vector<Case> AllCases() {
  std::vector<Case> all = LineCases();
  for (const auto& more : {ChannelCases(), BudgetCases()}) all.insert(all.end(), more.begin(), more.end());
  return all;
}

/// The line that ends with `#!`.
std::ptrdiff_t MarkedLine(const std::string& toml) {
  return 1 + std::count(toml.begin(), toml.begin() + static_cast<std::ptrdiff_t>(toml.find("#!")), '\n');
}

TEST(LinkRefusals, EachNamesItsLineAndKeyAndWhatWasExpected) {
  for (const Case& c : AllCases()) {
    const auto refusals = RefusalsOf(c.toml);
    for (const std::string& refusal : refusals) EXPECT_THAT(refusal, MatchesRegex(kForm));
    const std::string place = fmt::format("link.toml:{}:{}: ", MarkedLine(c.toml), c.key);
    EXPECT_TRUE(std::any_of(refusals.begin(), refusals.end(),
                            [&](const std::string& r) {
                              return r.starts_with(place) && r.find("expected " + c.expected) != r.npos;
                            }))
        << c.toml << "expected " << place << c.expected << "\n got " << testing::PrintToString(refusals);
  }
}

std::string SourceText(const std::string& source) {
  std::ifstream in(PRIAMOS_SOURCE_DIR "/bus/radio/" + source);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The sources that refuse a link.toml.
const std::vector<std::string> kSources{"link_config.cpp", "link_config_rules.cpp", "budget.cpp",
                                        "shared_budget.cpp", "channels/channel_table.cpp"};

/// What the sources can say of a link.toml: the beginning of each text after `expected`.
std::set<std::string> SentencesIn(const std::string& source) {
  const std::string text = SourceText(source);
  static const std::regex kRefuse(
      R"re((?:Refuse|Require)\(\s*"\w+",\s*(?:fmt::format\(\s*)?"((?:[^"\\{]|\\.)*))re"),
      kExpected(R"re("[^"\n]*\bexpected ((?:[^"\\{]|\\.)*))re"),
      kChoice(R"re([?:] (?:fmt::format\()?"((?:a|no) ttl_s[^{"]*))re");
  std::set<std::string> sentences;
  for (const std::regex& form : {kRefuse, kExpected, kChoice})
    for (std::sregex_iterator at(text.begin(), text.end(), form), end; at != end; ++at)
      if (const std::string words = std::regex_replace((*at)[1].str(), std::regex(R"(\\")"), "\"");
          !words.empty())
        sentences.insert(words);
  return sentences;
}

/// No link.toml brings about what is asked before.
const std::set<std::string> kOfChannelTablesAlone{
    "codes of 4, 6 or 8 bytes, got ",
    "a type whose packed size is known, got another",
    "a time-to-live, as every command needs, got none",
    "false, other than for a state of fixed size without keys, got true",
};

TEST(LinkRefusals, EverySentenceOfTheSourcesIsAmongThem) {
  std::string said;
  for (const Case& c : AllCases())
    for (const std::string& refusal : RefusalsOf(c.toml)) said += refusal + "\n";
  std::size_t sentences = 0;
  for (const std::string& source : kSources)
    for (const std::string& sentence : SentencesIn(source)) {
      ++sentences;
      if (sentence.starts_with("1 to ") || kOfChannelTablesAlone.contains(sentence)) continue;
      EXPECT_NE(said.find(sentence), said.npos) << source << ": no case for \"" << sentence << '"';
    }
  EXPECT_GE(sentences, 45U);
}

/// Statements that refuse; what they say is made of `expected ..., got ...`, or handed on.
TEST(LinkRefusals, NoStatementOfTheSourcesRefusesInOtherWords) {
  static const std::regex kStatement(R"re((?:problems\.push_back|throw [A-Za-z:_]+)\([^;]*;)re"),
      kWords(R"re(\bexpected\b|error\.what\(\)\);|problems\.front\(\))re");
  std::size_t statements = 0;
  for (const std::string& source : kSources) {
    const std::string text = SourceText(source);
    for (std::sregex_iterator at(text.begin(), text.end(), kStatement), end; at != end; ++at, ++statements)
      EXPECT_TRUE(std::regex_search((*at)[0].str(), kWords)) << source << ": " << (*at)[0].str();
  }
  EXPECT_GE(statements, 22U);
}

TEST(LinkRefusals, EveryKeyRefusesWhatItIsNot) {
  for (const ConfigKey& key : KeysOf<LinkConfig>()) {
    const bool of_channel = key.name.starts_with("channel[].");
    const std::string name = of_channel ? key.name.substr(10) : key.name;
    if (name == "channel[]") continue;
    std::size_t refused = 0;
    for (const char* value :
         {"\"A\\n\\u001b\"", "-1", "1e99", "nan", "-inf", "true", "[]", "{}", "1979-05-27", "65.5"}) {
      std::string toml = of_channel ? Link("") : Link(fmt::format("{} = {} #!", name, value));
      if (name == "simulation_key") toml.erase(0, toml.find('\n') + 1);
      if (of_channel) {
        const std::regex given("\n" + name + " = [^\n]*");
        toml = std::regex_replace(toml, given, "") + fmt::format("{} = {} #!\n", name, value);
      }
      for (const std::string& refusal : RefusalsOf(toml)) {
        EXPECT_THAT(refusal, MatchesRegex(kForm)) << toml;
        refused += refusal.starts_with(fmt::format("link.toml:{}:", MarkedLine(toml))) ? 1U : 0U;
      }
    }
    EXPECT_GE(refused, 6U) << key.name;
  }
}

TEST(LinkRefusals, WhatIsPrintedAsDefaultsIsTaken) {
  std::string toml;
  for (const ConfigKey& key : KeysOf<LinkConfig>())
    if (!key.value.empty() && !key.name.starts_with("channel[].") && key.name != "simulation_key")
      toml += fmt::format("{} = {}\n", key.name, key.value);
  EXPECT_THAT(RefusalsOf(Link(toml)), IsEmpty())
      << "a key that says what holds in any case is none without effect";
}

TEST(LinkRefusals, AStateNeedsTheTimeItTakesToArrive) {
  const std::vector<std::string> refusals = RefusalsOf(Link("", "ttl_s = 0.1"));
  ASSERT_EQ(refusals.size(), 1U);
  std::smatch worst;
  ASSERT_TRUE(std::regex_search(refusals[0], worst, std::regex("at least ([0-9.]+) s")));
  const double worst_s = std::stod(worst[1]);
  EXPECT_THAT(RefusalsOf(Link("", fmt::format("ttl_s = {}", worst_s + 0.001))), IsEmpty());
  EXPECT_EQ(RefusalsOf(Link("", fmt::format("ttl_s = {}", worst_s - 0.001))).size(), 1U);
  EXPECT_THAT(RefusalsOf(Link("", "ttl_s = 0")), IsEmpty()) << "no limit";
}

}  // namespace
}  // namespace priamos::radio
