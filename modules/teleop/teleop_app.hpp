#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string_view>

#include "bus/app.hpp"
#include "bus/context.hpp"
#include "lcmtypes/channels.hpp"
#include "teleop/device.hpp"
#include "teleop/teleop_config.hpp"
#include "teleop/teleop_messages.hpp"

namespace priamos::teleop {

/// An operator at the workstation with a space-mouse, keys or a joystick in the hand. See README.md.
class TeleopApp {
 public:
  static constexpr std::string_view kName = "teleop";
  static constexpr std::string_view kDefaultBus = "offboard";
  static constexpr std::string_view kSummary =
      "Driving by hand: space-mouse, joystick or keyboard to DRIVE_COMMAND and HEAD_DRIVE.";
  static constexpr std::array<bus::OptionAlias, 3> kOptions{
      {{"--show", "show", "true", "draw the stick and the robot's answer in the terminal"},
       {"--keyboard", "device", "\"keyboard\"", "drive with the keys of this terminal"},
       {"--joystick", "device", "\"joystick\"", "drive with an evdev joystick"}}};
  using Config = TeleopConfig;

  TeleopApp(const TeleopConfig& config, bus::Context& context);

  Duration TickPeriod() const { return FromSeconds(1 / config_.rate_hz); }
  void Tick(Time now);

 private:
  void TakeStatus();
  void Send(const PilotOutput& output, Time now);
  void ReportPhase();
  void Show(Time now);

  TeleopConfig config_;
  bus::Context& context_;
  std::unique_ptr<StickDevice> device_;
  Pilot pilot_;
  Stick stick_;
  Sender base_, head_;
  RobotView robot_;
  std::optional<drive_status_t> newest_;
  std::optional<PilotPhase> reported_;
  std::optional<Time> shown_;

  bus::Latest<drive_status_t> status_;
  bus::Publisher<drive_command_t> drive_;
  bus::Publisher<head_drive_t> head_drive_;
  bus::Publisher<lease_request_t> lease_;
  bus::Publisher<estop_t> estop_;
};

}  // namespace priamos::teleop
