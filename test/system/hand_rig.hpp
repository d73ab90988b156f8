#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "bus/lockstep.hpp"
#include "bus/own_types.hpp"
#include "cli/lockstep/factories.hpp"
#include "common/config.hpp"
#include "common/random.hpp"
#include "common/serial_port.hpp"
#include "teleop/emulated_mouse.hpp"
#include "test/support/radio/drive_freshness.hpp"
#include "test/support/radio/saturated_link.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos {

/// A hand at an emulated mouse, teleop, the radio, the robot and its world on an open field, in simulated
/// time. Any process can be killed and started again, the mouse unplugged, and the radio cut.
class HandRig {
 public:
  static constexpr std::uint32_t kDeadMan = 1u << 0, kEstopKey = 1u << 2, kRangeKey = 1u << 4;
  /// Speed of the wheels in the fast range [rad/s].
  static constexpr double kFullSpeed = 6.0;

  struct Options {
    bool saturated = false;  ///< more is offered to the radio, towards the robot, than it can carry
    std::uint64_t seed = 1;
    std::vector<bus::radio::LineCut> cuts{};
  };

  explicit HandRig(const Options& options)
      : rng(Rng::Stream(options.seed, "hand")),
        options_(options),
        lockstep_(schema_, {.seed = options.seed}),
        start_(lockstep_.now()) {
    lockstep_.AddBus("onboard");
    lockstep_.AddBus("offboard");
    bus::radio::LineConfig line;
    line.cuts = options.cuts;
    lockstep_.AddSerialLine("tty-onboard", "tty-offboard", line);
    lockstep_.AddSerialLine("tty-mouse", "tty-hand", {});
    mouse_line_ = lockstep_.OpenSerial("tty-hand");
    lockstep_.SetTap([this](std::string_view bus, Time now, std::string_view channel,
                            std::span<const std::byte> bytes) { Take(bus, now, channel, bytes); });
    for (const auto& [name, bus] : kAll) Begin(name, bus);
    bulk_ = std::make_unique<bus::Publisher<health_t>>(lockstep_.DriverNode("offboard"), "BULK");
    lockstep_.DriverNode("offboard").AdvertiseRaw("BULK");
    estop_ = std::make_unique<bus::Publisher<estop_t>>(
        lockstep_.DriverNode("offboard").Advertise(channels::kEstop));
  }

  /// Starts a process, for the first time or again.
  void Begin(const std::string& name, const std::string& bus) {
    ConfigSource source{Config(name + ".toml"), {}};
    if (name == "world") source.overrides = {"world=" + FieldWorld()};
    if (name == "teleop") source.overrides = {"device=serial", "spacemouse.port=tty-mouse"};
    if (name == "radio") source.overrides = {"side=" + bus, "port=tty-" + bus};
    if (name == "radio" && options_.saturated)
      source.overrides.push_back("link=" + WriteSaturatedLink(Config(""), folder_ / "link.toml"));
    lockstep_.AddApp(cli::FactoryFor(name), bus, source);
  }
  void Kill(const std::string& name, const std::string& bus) { lockstep_.RemoveApp(name, bus); }

  Time now() const { return lockstep_.now(); }
  double since_start_s() const { return Seconds(now() - start_); }
  bool Until(const std::function<bool()>& done, double most_s) {
    return lockstep_.RunUntil(now() + FromSeconds(most_s), [&] { return Step(), done(); });
  }
  void Wait(double seconds) {
    Until([] { return false; }, seconds);
  }

  /// Takes the lease and pushes in the fast range, towards the middle of the field, until the base is at full
  /// speed. Through a full radio a command may come too late, and the base stops in between.
  void DriveAtFullSpeed() {
    for (int attempt = 0; attempt < 4; ++attempt)
      if (TryFullSpeed()) return;
    FAIL() << "the base does not reach its full speed: " << Forward() << " rad/s, driver "
           << int(status.driver) << ", limit " << int(status.limit) << ", e-stop " << int(status.estop);
  }
  bool TryFullSpeed() {
    hand = {};
    Wait(0.3);
    hand.buttons = kDeadMan;
    if (!Until([this] { return status.driver == lease_request_t::TELEOP && !status.estop; }, 6)) return false;
    if (!fast_) Press(kRangeKey);
    fast_ = true;
    hand.axis[0] = truth.x_m > 2 ? -1 : 1;
    const auto fast = [this] { return std::abs(Forward()) > 0.95 * kFullSpeed; };
    if (!Until(fast, 4)) return false;
    Wait(rng.Uniform(0.1, 0.2));
    return fast();
  }
  void Press(std::uint32_t key) {
    hand.buttons |= key;
    Wait(0.15);
    hand.buttons &= ~key;
    Wait(0.05);
  }
  /// What teleop was told with its range key is forgotten when it starts again.
  void ForgetRange() { fast_ = false; }
  void SayEstop(std::int8_t action) {
    estop_t message{};
    message.utime = ToUtime(now());
    message.action = action;
    message.driver = lease_request_t::CONSOLE;
    estop_->Publish(message);
  }

  /// Mean of the wheels in the last command: the part that drives straight on. [rad/s]
  double Forward() const {
    if (wheels.empty()) return 0;
    const auto& s = wheels.back().message.speed_rad_s;
    return (s[0] + s[1] + s[2] + s[3]) / 4;
  }
  /// From `since` to the first command to stand, after which none may be another one [s]; NAN if there is
  /// none.
  double ToStandstill(Time since) const {
    for (std::size_t i = wheels.size(); i-- > 0;) {
      if (wheels[i].at < since) break;
      if (!IsZero(wheels[i].message)) return i + 1 < wheels.size() ? Seconds(wheels[i + 1].at - since) : NAN;
    }
    return 0;
  }
  double speed() const { return std::hypot(truth.vx_m_s, truth.vy_m_s); }

  Stick hand;
  bool mouse_plugged = true;
  /// Seen on the robot's bus since the start.
  std::vector<Seen<wheel_command_t>> wheels;
  std::vector<Seen<drive_command_t>> commands;
  drive_status_t status{};  ///< offboard
  drive_status_t onboard_status{};
  world_truth_t truth{};
  Rng rng;

  static constexpr std::pair<const char*, const char*> kAll[] = {
      {"world", "onboard"},  {"robot", "onboard"},    {"head", "onboard"},   {"radio", "onboard"},
      {"radio", "offboard"}, {"planner", "offboard"}, {"teleop", "offboard"}};

 private:
  static std::string Config(const std::string& name) {
    return std::string(PRIAMOS_SOURCE_DIR) + "/config/sim/" + name;
  }
  /// A map is looked for below the configuration; the field's is not there.
  std::string FieldWorld() const {
    const std::string file = folder_ / "field.toml", field = PRIAMOS_SOURCE_DIR "/test/bench/field";
    std::ofstream(file) << "map = \"" << field << "/map.toml\"\n"
                        << std::ifstream(field + "/world.toml").rdbuf();
    return file;
  }
  void Step() {
    std::array<std::byte, 64> heard;
    std::string bytes;
    while (const std::size_t n = mouse_line_->Read(heard))
      bytes.append(reinterpret_cast<const char*>(heard.data()), n);
    if (mouse_plugged) {
      const std::string packets = mouse_.Hear(bytes) + mouse_.Move(hand, now());
      mouse_line_->Write(std::as_bytes(std::span(packets)));
    }
    if (options_.saturated && now() >= next_bulk_) SayBulk();
  }
  void SayBulk() {
    next_bulk_ = now() + std::chrono::milliseconds(20);
    health_t message{};
    message.utime = ToUtime(now());
    message.process = "bulk";
    message.text = std::string(80, 'x') + std::to_string(rng.Below(1'000'000'000));
    bulk_->Publish(message);
  }
  void Take(std::string_view bus, Time now, std::string_view channel, std::span<const std::byte> bytes) {
    const auto is = [&](const auto& wanted) { return channel == wanted.name; };
    if (bus == "offboard") {
      if (is(channels::kDriveStatus)) status.decode(bytes.data(), 0, static_cast<int>(bytes.size()));
    } else if (is(channels::kDriveStatus)) {
      onboard_status.decode(bytes.data(), 0, static_cast<int>(bytes.size()));
    } else if (is(channels::kWorldTruth)) {
      truth.decode(bytes.data(), 0, static_cast<int>(bytes.size()));
    } else if (is(channels::kWheelCommand)) {
      wheels.push_back({now, {}});
      wheels.back().message.decode(bytes.data(), 0, static_cast<int>(bytes.size()));
    } else if (is(channels::kDriveCommand)) {
      commands.push_back({now, {}});
      commands.back().message.decode(bytes.data(), 0, static_cast<int>(bytes.size()));
    }
  }

  Options options_;
  const TemporaryFolder folder_;
  const bus::Schema schema_ = bus::OwnTypes();
  bus::Lockstep lockstep_;
  Time start_, next_bulk_{};
  std::unique_ptr<ByteStream> mouse_line_;
  teleop::EmulatedMouse mouse_{350};
  std::unique_ptr<bus::Publisher<health_t>> bulk_;
  std::unique_ptr<bus::Publisher<estop_t>> estop_;
  bool fast_ = false;
};

}  // namespace priamos
