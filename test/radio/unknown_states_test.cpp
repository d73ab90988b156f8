#include <gmock/gmock.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "bus/lockstep.hpp"
#include "bus/own_types.hpp"
#include "bus/schema/json.hpp"
#include "bus/type_files.hpp"
#include "radio/key_file.hpp"
#include "radio/radio_app.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::radio {
namespace {

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

}  // namespace
}  // namespace priamos::radio
