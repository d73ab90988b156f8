#include "bus/lockstep.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "bus/own_types.hpp"
#include "common/serial_port.hpp"

namespace priamos::bus {
namespace {

/// Publishes a pose every 20 ms and adds the one it heard to its own.
struct CountingConfig {
  int step = 1;
  void Describe(Archive& a) { a.Integer("step", step, {"-", 0, 9, "added per tick"}); }
};

class CountingApp {
 public:
  static constexpr std::string_view kName = "counting";
  static constexpr std::string_view kSummary = "counts";
  using Config = CountingConfig;
  CountingApp(const Config& config, Context& context)
      : config_(config),
        heard_(context.node().Subscribe(channels::kPose)),
        out_(context.node().Advertise(channels::kPose)) {}
  Duration TickPeriod() const { return std::chrono::milliseconds(20); }
  void Tick(Time now) {
    pose_t pose{};
    pose.utime = ToUtime(now);
    pose.x_m = (heard_.get() ? heard_.get()->x_m : 0) + config_.step;
    out_.Publish(pose);
  }

 private:
  Config config_;
  Latest<pose_t> heard_;
  Publisher<pose_t> out_;
};

/// Writes one byte per tick to a serial line and publishes what arrives.
struct PortConfig {
  std::string port;
  void Describe(Archive& a) { a.Text("port", port, "end of the line"); }
};

class EchoApp {
 public:
  static constexpr std::string_view kName = "echo";
  static constexpr std::string_view kSummary = "talks on a serial line";
  using Config = PortConfig;
  EchoApp(const Config& config, Context& context)
      : port_(context.OpenSerial(config.port, 9600)), out_(context.node().Advertise(channels::kPose)) {}
  Duration TickPeriod() const { return std::chrono::milliseconds(10); }
  void Tick(Time now) {
    const std::byte sent{1};
    port_->Write({&sent, 1});
    std::byte buffer[16];
    pose_t pose{};
    pose.utime = ToUtime(now);
    pose.x_m = static_cast<double>(received_ += port_->Read(buffer));
    out_.Publish(pose);
  }

 private:
  std::unique_ptr<ByteStream> port_;
  Publisher<pose_t> out_;
  std::size_t received_ = 0;
};

/// Believes nothing for 2.5 s.
struct NoConfig {
  void Describe(Archive&) {}
};

class RefusingApp {
 public:
  static constexpr std::string_view kName = "refusing";
  static constexpr std::string_view kSummary = "refuses";
  using Config = NoConfig;
  RefusingApp(const Config&, Context& context) : context_(context) {}
  Duration TickPeriod() const { return std::chrono::milliseconds(20); }
  void Tick(Time) {
    if (ticks_++ < 125) context_.LogRefusal("POSE", "not believed");
  }

 private:
  Context& context_;
  int ticks_ = 0;
};

std::vector<std::string> RecordRun(std::uint64_t seed) {
  const Schema schema = OwnTypes();
  Lockstep dut(schema, {.seed = seed});
  std::vector<std::string> events;
  dut.SetTap([&](std::string_view bus, Time now, std::string_view channel, std::span<const std::byte> bytes) {
    events.push_back(std::string(bus) + std::to_string(ToUtime(now)) + std::string(channel) +
                     std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  });
  dut.AddBus("a");
  dut.AddBus("b");
  radio::LineConfig line;
  line.bit_error_rate = 1e-2;
  dut.AddSerialLine("tty-a", "tty-b", line);
  dut.AddApp(FactoryOf<CountingApp>(), "a", {"", {"step=2"}});
  dut.AddApp(FactoryOf<EchoApp>(), "a", {"", {"port=tty-a"}});
  dut.AddApp(FactoryOf<EchoApp>(), "b", {"", {"port=tty-b"}});
  dut.RunUntil(dut.now() + std::chrono::seconds(3));
  return events;
}

TEST(Lockstep, SameSeedGivesIdenticalBytes) {
  const auto first = RecordRun(3);
  EXPECT_GT(first.size(), 500u);
  EXPECT_EQ(first, RecordRun(3));
}

TEST(Lockstep, AnotherSeedGivesAnotherLine) {
  EXPECT_NE(RecordRun(3), RecordRun(4));
}

TEST(Lockstep, AppsTickAtTheirOwnPeriods) {
  const Schema schema = OwnTypes();
  Lockstep dut(schema, {});
  int poses = 0, healths = 0;
  dut.SetTap([&](std::string_view, Time, std::string_view channel, std::span<const std::byte>) {
    ++(channel == "POSE" ? poses : healths);
  });
  dut.AddBus("a");
  dut.AddApp(FactoryOf<CountingApp>(), "a", {});
  dut.RunUntil(dut.now() + std::chrono::milliseconds(1999));
  EXPECT_EQ(poses, 100);
  EXPECT_EQ(healths, 2);
}

TEST(Lockstep, AFloodOfRefusalsIsToldOnceASecondAndCountedToItsEnd) {
  const Schema schema = OwnTypes();
  std::vector<std::string> told;
  Lockstep dut(schema, {.log = [&](Time, std::string_view, Level level, std::string_view text) {
                 EXPECT_EQ(level, Level::kWarning);
                 told.emplace_back(text);
               }});
  dut.AddBus("a");
  dut.AddApp(FactoryOf<RefusingApp>(), "a", {});
  dut.RunUntil(dut.now() + std::chrono::seconds(6));
  EXPECT_EQ(told, (std::vector<std::string>{"not believed", "not believed (POSE: 49 before it)",
                                            "not believed (POSE: 49 before it)", "POSE: 24 more refused"}));
}

TEST(Lockstep, BusesAreSeparate) {
  const Schema schema = OwnTypes();
  Lockstep dut(schema, {});
  dut.AddBus("a");
  dut.AddBus("b");
  dut.AddApp(FactoryOf<CountingApp>(), "a", {});
  const auto elsewhere = dut.DriverNode("b").Subscribe(channels::kPose);
  const auto here = dut.DriverNode("a").Subscribe(channels::kPose);
  dut.RunUntil(dut.now() + std::chrono::milliseconds(100));
  EXPECT_NE(here.get(), nullptr);
  EXPECT_EQ(elsewhere.get(), nullptr);
}

TEST(Lockstep, DoneEndsTheRunAtOnce) {
  const Schema schema = OwnTypes();
  Lockstep dut(schema, {});
  dut.AddBus("a");
  dut.AddApp(FactoryOf<CountingApp>(), "a", {});
  int steps = 0;
  EXPECT_TRUE(dut.RunUntil(Time::max(), [&] { return ++steps == 5; }));
  EXPECT_EQ(steps, 5);
}

TEST(Lockstep, UnknownPortIsASentence) {
  const Schema schema = OwnTypes();
  Lockstep dut(schema, {});
  dut.AddBus("a");
  EXPECT_THROW(dut.AddApp(FactoryOf<EchoApp>(), "a", {"", {"port=tty-x"}}), std::runtime_error);
}

}  // namespace
}  // namespace priamos::bus
