#include "radio/radio_app.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "bus/lockstep.hpp"
#include "bus/own_types.hpp"
#include "bus/schema/json.hpp"
#include "bus/type_files.hpp"
#include "radio/key_file.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::radio {
namespace {

using testing::HasSubstr;

const std::string kConfig = std::string(PRIAMOS_SOURCE_DIR) + "/config/sim/radio.toml";

/// Both ends of a link, each on its bus, in lockstep.
struct RadioAppTest : testing::Test {
  explicit RadioAppTest(const bus::radio::LineConfig& line = {}) {
    lockstep.AddBus("onboard");
    lockstep.AddBus("offboard");
    lockstep.AddSerialLine("tty-onboard", "tty-offboard", line);
    for (const std::string side : {"onboard", "offboard"})
      lockstep.AddApp(bus::FactoryOf<RadioApp>(), side, {kConfig, {"side=" + side, "port=tty-" + side}});
  }
  void Run(double seconds) { lockstep.RunUntil(lockstep.now() + FromSeconds(seconds)); }
  bus::Node& onboard() { return lockstep.DriverNode("onboard"); }
  bus::Node& offboard() { return lockstep.DriverNode("offboard"); }

  bus::Schema schema = bus::OwnTypes();
  bus::Lockstep lockstep{schema, {.seed = 1, .start = FromUtime(1'000'000'000), .log = {}}};
};

TEST_F(RadioAppTest, PoseReachesTheOtherBusWithItsAge) {
  auto poses = offboard().Subscribe(channels::kPose);
  auto publisher = onboard().Advertise(channels::kPose);
  Run(1);
  pose_t pose{};
  pose.utime = ToUtime(lockstep.now()) - 200'000;
  pose.x_m = 1.234;
  pose.yaw_rad = -0.5;
  publisher.Publish(pose);
  Run(0.5);
  const pose_t* received = poses.get();
  ASSERT_NE(received, nullptr);
  EXPECT_NEAR(received->x_m, 1.234, 0.0051);
  EXPECT_NEAR(received->yaw_rad, -0.5, 0.00051);
  EXPECT_NEAR(static_cast<double>(received->utime - pose.utime), 0, 20'000);
}

/// However late it comes onto the bus: the radio counts a command's age from its own stamp.
TEST_F(RadioAppTest, ACommandThatIsTooOldOnTheBusIsNotSent) {
  auto commands = onboard().SubscribeAll(channels::kDriveCommand);
  auto status = offboard().Subscribe(channels::kLinkStatus);
  auto publisher = offboard().Advertise(channels::kDriveCommand);
  Run(3);
  drive_command_t command{};
  command.time_to_live_s = 0.25;
  int expired = 0;
  for (const int age_us : {0, 100'000, 300'000, 60'000'000, -1'000'000}) {
    const std::int64_t offered = ToUtime(lockstep.now());
    command.utime = offered - age_us;
    ++command.sequence;
    publisher.Publish(command);
    Run(1.1);
    const auto came = commands.Drain();
    ASSERT_EQ(came.size(), age_us < 200'000 ? 1u : 0u) << age_us;
    for (const drive_command_t& arrived : came) {
      EXPECT_LE(arrived.utime, std::min(command.utime, ToUtime(lockstep.now())) + 1000)
          << "never younger than it is";
      EXPECT_GE(arrived.utime, std::min(command.utime, offered) - 70'000)
          << "nor older by the step of its stamp, 0.1 s: of what counts from it nothing is rounded";
    }
    expired += age_us > 200'000 ? 1 : 0;
    EXPECT_EQ(status.get()->dropped, expired) << age_us;
  }
  command.utime = std::numeric_limits<std::int64_t>::min();
  publisher.Publish(command);
  Run(1.5);
  EXPECT_TRUE(commands.Drain().empty());
}

/// Not to send a stop is the unsafe side; to send a REARM that nobody can have meant is the other.
TEST_F(RadioAppTest, AStopCrossesWhateverItsOtherFieldsHoldAndAReArmDoesNot) {
  auto stops = onboard().SubscribeAll(channels::kEstop);
  auto publisher = offboard().Advertise(channels::kEstop);
  auto status = offboard().Subscribe(channels::kLinkStatus);
  Run(0.5);
  for (const int driver : {4, -1, 127, -128, 2}) {
    for (const std::int8_t action : {estop_t::STOP, estop_t::REARM}) {
      estop_t message{};
      message.utime = driver == 127 ? std::numeric_limits<std::int64_t>::min() : ToUtime(lockstep.now());
      message.action = action;
      message.driver = static_cast<std::int8_t>(driver);
      publisher.Publish(message);
      Run(0.5);
      const auto came = stops.Drain();
      ASSERT_EQ(came.size(), action == estop_t::STOP || driver == 2 ? 1U : 0U) << driver;
      for (const estop_t& arrived : came) EXPECT_EQ(arrived.driver, std::clamp(driver, 0, 3));
    }
  }
  Run(1.5);
  ASSERT_NE(status.get(), nullptr);
  EXPECT_EQ(status.get()->dropped, 4) << "the REARMs with no driver";
}

/// Half a step beside the range is the nearest value; a number that is none has none.
TEST_F(RadioAppTest, NoNumberAndNoIdentityArriveAsAnotherOne) {
  auto commands = onboard().SubscribeAll(channels::kDriveCommand);
  auto publisher = offboard().Advertise(channels::kDriveCommand);
  Run(1);
  const auto arrives = [&](double vx_m_s, int session, int sequence) {
    drive_command_t command{};
    command.utime = ToUtime(lockstep.now());
    command.time_to_live_s = 0.25;
    command.vx_m_s = vx_m_s;
    command.session = static_cast<std::int16_t>(session);
    command.sequence = sequence;
    publisher.Publish(command);
    Run(0.5);
    return !commands.Drain().empty();
  };
  EXPECT_TRUE(arrives(9, 255, 65535));
  for (const double value : {std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_FALSE(arrives(value, 1, 1)) << value;
  EXPECT_FALSE(arrives(0, 256, 1)) << "it would be session 255";
  EXPECT_FALSE(arrives(0, -1, 1));
  EXPECT_FALSE(arrives(0, 1, 65536));
  EXPECT_TRUE(arrives(0, 1, 1));
}

TEST_F(RadioAppTest, EventsCrossBothWaysOnceAndInOrder) {
  auto looks = onboard().SubscribeAll(channels::kLookRequest);
  auto fixes = offboard().SubscribeAll(channels::kLandmarkFix);
  auto look = offboard().Advertise(channels::kLookRequest);
  auto fix = onboard().Advertise(channels::kLandmarkFix);
  Run(0.5);
  for (int i = 1; i <= 3; ++i) {
    look_request_t request{};
    request.utime = ToUtime(lockstep.now());
    request.request_id = i;
    look.Publish(request);
    landmark_fix_t answer{};
    answer.utime_exposure = ToUtime(lockstep.now());
    answer.request_id = i;
    fix.Publish(answer);
    Run(1);
  }
  Run(5);
  const auto looked = looks.Drain();
  const auto fixed = fixes.Drain();
  ASSERT_EQ(looked.size(), 3U);
  ASSERT_EQ(fixed.size(), 3U);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(looked[static_cast<std::size_t>(i)].request_id, i + 1);
    EXPECT_EQ(fixed[static_cast<std::size_t>(i)].request_id, i + 1);
  }
}

TEST_F(RadioAppTest, WhatWasPublishedBeforeTheFirstTickIsSent) {
  auto models = onboard().SubscribeAll(channels::kLandmarkModel);
  auto model = offboard().Advertise(channels::kLandmarkModel);
  landmark_model_t message{};
  message.landmark_id = 1;
  message.n_edges = 20;
  message.edges.resize(20);
  for (auto& edge : message.edges) edge.x1_m = 0.5;
  model.Publish(message);
  Run(3);
  const auto received = models.Drain();
  ASSERT_EQ(received.size(), 1U);
  EXPECT_EQ(received[0].edges.size(), 20U);
}

TEST_F(RadioAppTest, StatusSaysWhatWasSent) {
  auto status = onboard().Subscribe(channels::kLinkStatus);
  auto publisher = onboard().Advertise(channels::kPose);
  for (int i = 0; i < 250; ++i) {
    pose_t pose{};
    pose.utime = ToUtime(lockstep.now());
    publisher.Publish(pose);
    Run(0.02);
  }
  ASSERT_NE(status.get(), nullptr);
  EXPECT_TRUE(status.get()->up);
  EXPECT_FALSE(status.get()->alarm);
  EXPECT_EQ(status.get()->frames_rejected, 0);
  EXPECT_GT(status.get()->utilisation, 0.05);
  EXPECT_LT(status.get()->utilisation, 0.5);
  for (const auto& channel : status.get()->channels) {
    if (channel.channel != "POSE") continue;
    EXPECT_TRUE(channel.outgoing);
    EXPECT_NEAR(channel.messages, 40, 8);
  }
}

TEST_F(RadioAppTest, HealthOfEveryProcessGetsThrough) {
  auto health = offboard().SubscribeAll(channels::kHealth);
  auto publisher = onboard().Advertise(channels::kHealth);
  std::set<std::string> heard;
  for (int i = 0; i < 12; ++i) {
    for (const char* process : {"robot", "head", "world"}) {
      health_t message{};
      message.utime = ToUtime(lockstep.now());
      message.process = process;
      publisher.Publish(message);
    }
    Run(1);
  }
  for (const auto& message : health.Drain()) heard.insert(message.process);
  EXPECT_THAT(heard, testing::IsSupersetOf({"robot", "head", "world"}));
}

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

// ---- Types the program was never compiled with, and channels that are sent on request.

constexpr const char* kForeignType =
    "package yours;\n"
    "struct tank_t {\n"
    "  int64_t timestamp;  // [us] @age 1000000 @step 10000: when\n"
    "  double level_m;     // [m] @range 0,10 @step 0.01: water\n"
    "}\n";
constexpr const char* kForeignLink = R"(
simulation_key = true
[[channel]]
name = "TANK"
type = "tank_t"
direction = "up"
class = "state"
rate_hz = 10
[[channel]]
name = "DETAILS"
type = "tank_t"
direction = "up"
class = "state"
rate_hz = 10
on_request = true
)";

/// One link.toml for both ends, given as their configuration, and a folder of types.
struct ForeignTypes : testing::Test {
  explicit ForeignTypes(const std::string& link = kForeignLink) {
    std::filesystem::create_directories(folder / "types");
    std::ofstream(folder / "types" / "tank_t.lcm") << kForeignType;
    std::ofstream(folder / "link.toml") << link;
    types = (folder / "types").string();
    lockstep.AddBus("onboard");
    lockstep.AddBus("offboard");
    lockstep.AddSerialLine("tty-onboard", "tty-offboard", {});
    for (const std::string side : {"onboard", "offboard"})
      lockstep.AddApp(
          bus::FactoryOf<RadioApp>(), side,
          {(folder / "link.toml").string(), {"side=" + side, "port=tty-" + side, "types=" + types}});
    lockstep.SetTap([&](std::string_view bus, Time, std::string_view channel, auto bytes) {
      if (channel == "TANK") ++n_tanks[bus == "offboard"];
      if (bus == "offboard" && channel == "TANK") tanks.emplace_back(bytes.begin(), bytes.end());
      if (bus == "offboard" && channel == "DETAILS") ++details;
    });
  }
  std::vector<std::byte> Tank(double level_m) {
    const bus::Schema foreign(bus::ReadTypeFiles(types));
    return bus::FromJson(*foreign.Find("tank_t"),
                         {{"timestamp", ToUtime(lockstep.now())}, {"level_m", level_m}});
  }
  void Run(double seconds) {
    const Time end = lockstep.now() + FromSeconds(seconds);
    while (lockstep.now() < end) {
      for (const char* channel : {"TANK", "DETAILS"})
        lockstep.DriverNode("onboard").PublishRaw(channel, Tank(1.234));
      lockstep.RunUntil(lockstep.now() + FromSeconds(0.05));
    }
  }

  TemporaryFolder folder;
  bus::Schema schema = bus::OwnTypes();
  bus::Lockstep lockstep{schema, {.seed = 1, .start = FromUtime(1'000'000'000), .log = {}}};
  std::string types;
  std::vector<std::vector<std::byte>> tanks;
  std::array<int, 2> n_tanks{};  ///< on the bus onboard and offboard
  int details = 0;
};

/// The same channel up and down.
struct BothWays : ForeignTypes {
  BothWays()
      : ForeignTypes(
            "simulation_key = true\n[[channel]]\nname = \"TANK\"\ntype = \"tank_t\"\ndirection = \"up\"\n"
            "class = \"state\"\nrate_hz = 10\n[[channel]]\nname = \"TANK\"\ntype = \"tank_t\"\n"
            "direction = \"down\"\nclass = \"state\"\nrate_hz = 10\n") {}
};

TEST_F(BothWays, WhatTheLinkBroughtIsNotSentBack) {
  lockstep.RunUntil(lockstep.now() + FromSeconds(3));
  for (const char* side : {"onboard", "offboard"}) {
    n_tanks = {};
    lockstep.DriverNode(side).PublishRaw("TANK", Tank(1.234));
    lockstep.RunUntil(lockstep.now() + FromSeconds(5));
    EXPECT_EQ(n_tanks[0], 1) << side;
    EXPECT_EQ(n_tanks[1], 1) << side;
  }
}

TEST_F(ForeignTypes, AreBridged) {
  Run(2);
  ASSERT_GT(tanks.size(), 10U);
  const bus::Schema foreign(bus::ReadTypeFiles(types));
  EXPECT_NEAR(bus::ToJson(*foreign.Find("tank_t"), tanks.back()).at("level_m").get<double>(), 1.23, 1e-9);
}

TEST_F(ForeignTypes, OnRequestIsSentWhileSomebodyListens) {
  Run(2);
  EXPECT_EQ(details, 0);
  auto requests = lockstep.DriverNode("offboard").Advertise(channels::kLinkRequest);
  link_request_t request{};
  request.channel = "DETAILS";
  request.hold_s = 2;
  requests.Publish(request);
  Run(1.5);
  EXPECT_GT(details, 8);
  Run(1.5);
  details = 0;
  Run(2);
  EXPECT_EQ(details, 0);
}

TEST_F(ForeignTypes, StatusCountsWhatNobodyWanted) {
  auto status = lockstep.DriverNode("onboard").Subscribe(channels::kLinkStatus);
  Run(3);
  ASSERT_NE(status.get(), nullptr);
  ASSERT_EQ(status.get()->all_channels, 2);
  EXPECT_TRUE(status.get()->onboard);
  EXPECT_GT(status.get()->channels[1].unwanted, 30);
  EXPECT_EQ(status.get()->channels[0].unwanted, 0);
  EXPECT_GT(status.get()->utilisation_in, 0);
}

// ---- Enumerations out of range.

constexpr const char* kGateType =
    "package yours;\n"
    "struct gate_t {\n"
    "  const int8_t SHUT = 0, OPEN = 1, STUCK = 5;\n"
    "  int8_t state;  // [-] @range 0,5: SHUT, OPEN, ...\n"
    "  int8_t level;  // [-] @range 0,5: of the water\n"
    "}\n";

/// A channel of gates from the robot; what arrives at the other end, as JSON.
struct Gates : testing::Test {
  explicit Gates(const std::string& channel_class = "state") {
    std::filesystem::create_directories(folder / "types");
    std::ofstream(folder / "types" / "gate_t.lcm") << kGateType;
    std::ofstream(folder / "link.toml") << "simulation_key = true\n[[channel]]\nname = \"GATE\"\ntype = "
                                           "\"gate_t\"\ndirection = \"up\"\nrate_hz = 10\nclass = \""
                                        << channel_class << "\"\n";
    lockstep.AddBus("onboard");
    lockstep.AddBus("offboard");
    lockstep.AddSerialLine("tty-onboard", "tty-offboard", {});
    for (const std::string side : {"onboard", "offboard"})
      lockstep.AddApp(bus::FactoryOf<RadioApp>(), side,
                      {(folder / "link.toml").string(),
                       {"side=" + side, "port=tty-" + side, "types=" + (folder / "types").string()}});
    lockstep.SetTap([&](std::string_view bus, Time, std::string_view channel, auto bytes) {
      if (bus == "offboard" && channel == "GATE") arrived.push_back(bus::ToJson(Type(), bytes).dump());
    });
  }
  const bus::Struct& Type() const { return *types.Find("gate_t"); }
  void Send(int state, int level) {
    lockstep.DriverNode("onboard").PublishRaw("GATE",
                                              bus::FromJson(Type(), {{"state", state}, {"level", level}}));
    lockstep.RunUntil(lockstep.now() + FromSeconds(0.5));
  }
  void ExpectOnlyTheGoodOnesArrive() {
    auto status = lockstep.DriverNode("onboard").Subscribe(channels::kLinkStatus);
    lockstep.RunUntil(lockstep.now() + FromSeconds(1));
    for (const int state : {0, 9, 5, 6, -1}) Send(state, 0);
    Send(1, 9);
    lockstep.RunUntil(lockstep.now() + FromSeconds(2));
    EXPECT_THAT(arrived, testing::ElementsAre(R"({"state":0,"level":0})", R"({"state":5,"level":0})",
                                              R"({"state":1,"level":5})"))
        << "a level out of range has a nearest one";
    ASSERT_NE(status.get(), nullptr);
    const link_channel_t& gate = status.get()->channels.at(0);
    EXPECT_EQ(gate.dropped, 3);
    EXPECT_EQ(gate.expired, 0);
    EXPECT_EQ(gate.saturated, 1);
    EXPECT_EQ(gate.messages, 3);
    EXPECT_EQ(status.get()->dropped, 3);
  }

  TemporaryFolder folder;
  bus::Schema types{std::vector<bus::Schema::Source>{{"gate_t.lcm", kGateType}}};
  bus::Schema schema = bus::OwnTypes();
  bus::Lockstep lockstep{schema, {.seed = 1, .start = FromUtime(1'000'000'000), .log = {}}};
  std::vector<std::string> arrived;
};

struct GateEvents : Gates {
  GateEvents() : Gates("event") {}
};

TEST_F(Gates, OfNoKnownStateAreNotSentAndCounted) {
  ExpectOnlyTheGoodOnesArrive();
}

TEST_F(GateEvents, OfNoKnownStateAreNotSentAndCounted) {
  ExpectOnlyTheGoodOnesArrive();
}

/// The other end of the line, which packs as it likes: sends the code in its configuration's `types` for
/// ever.
struct OtherEnd {
  static constexpr std::string_view kName = "radio";
  static constexpr std::string_view kSummary = "An end with a mistake.";
  static constexpr std::array<bus::OptionAlias, 0> kOptions{};
  static constexpr bool kOneOwner = false;
  using Config = RadioConfig;

  OtherEnd(const RadioConfig& config, bus::Context& context)
      : port(context.OpenSerial(config.port, 9600)),
        link(
            config.own_link.Table(bus::Schema(bus::ReadTypeFiles(config.types))), bus::radio::Direction::kUp,
            SimulationKey(), config.own_link.Options(), store,
            [](std::size_t, std::span<const std::byte> encoded, Time) {
              return std::optional(bus::radio::Packed{{encoded.begin(), encoded.end()}, 6});
            },
            [n = std::uint64_t{1}]() mutable { return n++; }, FromUtime(1'000'000'000)) {}
  Duration TickPeriod() const { return FromSeconds(0.001); }
  void Tick(Time now) {
    std::array<std::byte, 256> buffer;
    while (const std::size_t n = port->Read(buffer)) link.Receive(std::span(buffer).first(n), now);
    if (now >= next) {
      const std::byte codes{static_cast<unsigned char>(sent++ % 8 << 5)};  // 3 bits of state, 3 of level
      link.Offer(0, std::span(&codes, 1), now);
      next = now + FromSeconds(0.5);
    }
    port->Write(link.Step(now));
  }

  std::unique_ptr<ByteStream> port;
  bus::radio::MemoryStore store;
  bus::radio::LinkEndpoint link;
  Time next = FromUtime(1'001'000'000);
  int sent = 0;
};

TEST(GateReceiver, CodesOfNoStateAreABadMessageAndCounted) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "types");
  std::ofstream(folder / "types" / "gate_t.lcm") << kGateType;
  std::ofstream(folder / "link.toml")
      << "simulation_key = true\n[[channel]]\nname = \"GATE\"\ntype = \"gate_t\"\ndirection = "
         "\"up\"\nclass = \"state\"\nrate_hz = 10\n";
  const bus::Schema schema = bus::OwnTypes();
  const bus::Schema types(std::vector<bus::Schema::Source>{{"gate_t.lcm", kGateType}});
  bus::Lockstep lockstep(schema, {.seed = 1, .start = FromUtime(1'000'000'000), .log = {}});
  lockstep.AddBus("onboard");
  lockstep.AddBus("offboard");
  lockstep.AddSerialLine("tty-onboard", "tty-offboard", {});
  const std::string link = (folder / "link.toml").string(), lcm = "types=" + (folder / "types").string();
  lockstep.AddApp(bus::FactoryOf<OtherEnd>(), "onboard", {link, {"port=tty-onboard", lcm}});
  lockstep.AddApp(bus::FactoryOf<RadioApp>(), "offboard",
                  {link, {"side=offboard", "port=tty-offboard", lcm}});
  std::vector<int> states;
  lockstep.SetTap([&](std::string_view bus, Time, std::string_view channel, auto bytes) {
    if (bus == "offboard" && channel == "GATE")
      states.push_back(bus::ToJson(*types.Find("gate_t"), bytes).at("state").template get<int>());
  });
  auto status = lockstep.DriverNode("offboard").Subscribe(channels::kLinkStatus);
  lockstep.RunUntil(FromUtime(1'007'000'000));
  EXPECT_THAT(std::set<int>(states.begin(), states.end()), testing::ElementsAre(0, 1, 2, 3, 4, 5));
  ASSERT_NE(status.get(), nullptr);
  EXPECT_GE(status.get()->undecodable, 2);
  EXPECT_EQ(status.get()->frames_rejected, 0);
}

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
