#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "bus/lockstep.hpp"
#include "bus/own_types.hpp"
#include "radio/radio_app.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::radio {
namespace {

using testing::HasSubstr;

std::string StartError(const std::string& text, const std::string& link = "") {
  const TemporaryFolder folder;
  std::ofstream(folder / "radio.toml") << text;
  std::ofstream(folder / "link.toml") << link;
  const bus::Schema schema = bus::OwnTypes();
  bus::Lockstep lockstep(schema, {.seed = 1, .start = FromUtime(1'000'000'000), .log = {}});
  lockstep.AddBus("onboard");
  lockstep.AddSerialLine("a", "b", {});
  try {
    lockstep.AddApp(bus::FactoryOf<RadioApp>(), "onboard", {(folder / "radio.toml").string(), {}});
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

constexpr const char* kWhither = "direction='up'\nclass='state'\n";

constexpr const char* kPoseLink = R"(
simulation_key = true
[[channel]]
name = "POSE"
type = "pose_t"
direction = "up"
class = "state"
)";

/// The text of HEALTH of the robot's end when the ends have codes of these lengths.
std::string HealthWithCodes(int onboard_bytes, int offboard_bytes) {
  const bus::Schema schema = bus::OwnTypes();
  bus::Lockstep lockstep(schema, {.seed = 1, .start = FromUtime(1'000'000'000), .log = {}});
  lockstep.AddBus("onboard");
  lockstep.AddBus("offboard");
  lockstep.AddSerialLine("tty-onboard", "tty-offboard", {});
  const TemporaryFolder folder;
  for (const std::string side : {"onboard", "offboard"}) {
    const std::string link = folder / (side + ".toml");
    std::ofstream(link) << "code_bytes = " << (side == "onboard" ? onboard_bytes : offboard_bytes)
                        << kPoseLink;
    lockstep.AddApp(bus::FactoryOf<RadioApp>(), side, {link, {"side=" + side, "port=tty-" + side}});
  }
  auto health = lockstep.DriverNode("onboard").SubscribeAll(channels::kHealth);
  lockstep.RunUntil(lockstep.now() + FromSeconds(5));
  std::string text = "no HEALTH";
  for (const health_t& message : health.Drain()) text = message.text;
  return text;
}

TEST(RadioAppCodes, EndsWithOtherLengthsSayWhichAndWhereToChangeThem) {
  EXPECT_EQ(HealthWithCodes(4, 8),
            "the other end has codes of 8 bytes, this one of 4: set code_bytes alike in both link.toml");
  EXPECT_EQ(HealthWithCodes(6, 4),
            "the other end has codes of 4 bytes, this one of 6: set code_bytes alike in both link.toml");
  EXPECT_EQ(HealthWithCodes(8, 8), "");
  EXPECT_EQ(HealthWithCodes(4, 0), "") << "4 is the default at 9600 baud";
}

TEST(RadioAppStart, KeysOfALinkWithoutChannelsAreRefused) {
  EXPECT_THAT(StartError("port = 'a'\nbaud = 1200", kPoseLink), HasSubstr("channel"));
}

TEST(RadioAppStart, RefusesAPortThatIsNoAddress) {
  EXPECT_THAT(StartError("\nport = 'tcp::99999'", kPoseLink),
              HasSubstr("radio.toml:2:port: expected udp:HOST:PORT"));
}

/// Saving would replace it.
TEST(RadioAppStart, RefusesAStateFileThatIsNoFile) {
  EXPECT_THAT(
      StartError("port = 'a'\nstate_file = '/dev/null'", kPoseLink),
      HasSubstr(
          "radio.toml:2:state_file: expected a file, or the name of none yet, got a device, \"/dev/null\""));
  EXPECT_THAT(
      StartError("port = 'a'\nstate_file = 'new'\nfast_state_file = '/tmp'", kPoseLink),
      HasSubstr("radio.toml:3:fast_state_file: expected a file, or the name of none yet, got a folder"));
  EXPECT_EQ(StartError("port = 'a'\nstate_file = 'new'", kPoseLink), "");
}

/// Whatever it is, it would be lost.
TEST(RadioAppStart, RefusesAStateFileThatHoldsSomethingElse) {
  const TemporaryFolder folder;
  const std::string notes = folder / "notes.txt";
  std::ofstream(notes) << "my important notes\n";
  for (const auto& [config, place] :
       {std::pair("state_file = '" + notes + "'", "radio.toml:2:state_file"),
        std::pair("state_file = 'new'\nfast_state_file = '" + notes + "'", "radio.toml:3:fast_state_file")})
    EXPECT_THAT(
        StartError("port = 'a'\n" + config, kPoseLink),
        AllOf(HasSubstr(place), HasSubstr("expected a state of the radio, or the name of no file yet, got "
                                          "a file that holds something else")));
  std::string left;
  std::getline(std::ifstream(notes), left);
  EXPECT_EQ(left, "my important notes");
  EXPECT_THAT(StartError("port = 'a'\nstate_file = '/proc/self/mem'", kPoseLink),
              HasSubstr("radio.toml:2:state_file: expected the radio's state"));
}

TEST(RadioAppStart, RefusesOneFileForTwoThings) {
  const TemporaryFolder folder;
  const std::string state = folder / "state", link = folder / "link";
  std::filesystem::create_symlink(state, link);
  for (const std::string& fast : {state, (folder / "./state").string(), link})
    EXPECT_THAT(
        StartError("port = 'a'\nstate_file = '" + state + "'\nfast_state_file = '" + fast + "'", kPoseLink),
        HasSubstr("radio.toml:3:fast_state_file: expected a file of its own, got that of state_file"));
  const FileStore other(state);
  EXPECT_THAT(StartError("port = 'a'\nstate_file = '" + link + "'", kPoseLink),
              HasSubstr("radio.toml:2:state_file: expected a file of its own, got one that another end"));
}

TEST(RadioAppStart, AMemoryOnARamDiskAloneIsRefused) {
  EXPECT_THAT(StartError("port = 'a'\nfast_state_file = 'new'", kPoseLink),
              HasSubstr("radio.toml:2:fast_state_file: expected none without a state_file"));
}

TEST(RadioAppStart, ALinkBesideTheChannelsOfTheSameFileIsRefused) {
  EXPECT_THAT(StartError(std::string("link = 'other.toml'\n") + kPoseLink),
              HasSubstr("radio.toml:1:link: expected none beside [[channel]] tables"));
}

TEST(RadioAppStart, UdpNeedsDatagrams) {
  EXPECT_THAT(StartError("port = 'udp:127.0.0.1:9000'", kPoseLink), HasSubstr("datagrams: expected true"));
}

TEST(RadioAppStart, ShippedConfigurationFits) {
  EXPECT_EQ(StartError("port = 'a'", kPoseLink), "");
}

TEST(RadioAppStart, RefusesALinkThatCannotHold) {
  EXPECT_THAT(StartError("port = 'a'", std::string(kPoseLink) + "rate_hz = 100"),
              HasSubstr("expected at most 960 byte/s"));
  EXPECT_THAT(StartError("port = 'a'", std::string(kPoseLink) + "deadline_s = 0.01"),
              HasSubstr("deadline_s"));
}

TEST(RadioAppStart, RefusesWhatMustNeverCrossTheRadio) {
  for (const char* channel :
       {"name='CLAIM'\ntype='claim_t'", "name='PROBE'\ntype='probe_t'",
        "name='WHEEL_COMMAND'\ntype='wheel_command_t'", "name='LINK_STATUS'\ntype='link_status_t'",
        "name='CLOCK'\ntype='clock_report_t'", "name='LINK_REQUEST'\ntype='link_request_t'"})
    EXPECT_THAT(
        StartError("port = 'a'", std::string("simulation_key=true\n[[channel]]\n") + kWhither + channel),
        AllOf(HasSubstr("link.toml:"),
              HasSubstr("channel[0].name: expected a channel that may cross the radio")));
}

TEST(RadioAppStart, RefusesAMissingKey) {
  EXPECT_THAT(StartError("port = 'a'", std::string("[[channel]]\nname='POSE'\ntype='pose_t'\n") + kWhither),
              HasSubstr("priamos link keygen"));
}

TEST(RadioAppStart, RefusesUnknownTypes) {
  EXPECT_THAT(
      StartError("port = 'a'",
                 std::string("simulation_key=true\n[[channel]]\nname='POSE'\ntype='pos_t'\n") + kWhither),
      AllOf(HasSubstr("link.toml:4:channel[0].type: radio channel POSE: "), HasSubstr("got \"pos_t\"")));
}

TEST(RadioAppStart, RefusesAChannelThatDoesNotSayWhatItIs) {
  const std::string channel = "simulation_key=true\n[[channel]]\nname='POSE'\ntype='pose_t'\n";
  EXPECT_THAT(StartError("port = 'a'", channel + "class='state'\n"),
              HasSubstr("link.toml:2:channel[0].direction: expected up or down, got none"));
  EXPECT_THAT(StartError("port = 'a'", channel + "direction='up'\n"),
              HasSubstr("link.toml:2:channel[0].class: expected state, event or command, got none"));
}

TEST(RadioAppStart, NamesThePlaceOfAChannelThatIsListedTwice) {
  const std::string channel = std::string("[[channel]]\nname='POSE'\ntype='pose_t'\n") + kWhither;
  EXPECT_THAT(StartError("port = 'a'", "simulation_key=true\n" + channel + channel),
              HasSubstr("link.toml:8:channel[1].name: radio channel POSE: expected a channel once"));
}

}  // namespace
}  // namespace priamos::radio
