#include "teleop/teleop_app.hpp"

#include <iostream>
#include <random>

#include "common/random.hpp"
#include "teleop/core/keyboard.hpp"

namespace priamos::teleop {
namespace {

constexpr Duration kShowPeriod = std::chrono::milliseconds(100);

/// Distinguishes two teleop processes.
int DrawSession(const bus::Context& context) {
  if (context.lockstep()) return static_cast<int>(Rng::Stream(context.seed(), "teleop session").Below(256));
  return static_cast<int>(std::random_device{}() % 256);
}

}  // namespace

TeleopApp::TeleopApp(const TeleopConfig& config, bus::Context& context)
    : config_(config),
      context_(context),
      device_(MakeDevice(config, context)),
      pilot_(config.pilot),
      status_(context.node().Subscribe(channels::kDriveStatus)),
      drive_(context.node().Advertise(channels::kDriveCommand)),
      head_drive_(context.node().Advertise(channels::kHeadDrive)),
      lease_(context.node().Advertise(channels::kLeaseRequest)),
      estop_(context.node().Advertise(channels::kEstop)) {
  base_.session = head_.session = DrawSession(context);
}

void TeleopApp::Tick(Time now) {
  TakeStatus();
  stick_ = device_->Poll(now);
  Send(pilot_.Step(stick_, robot_, now), now);
  ReportPhase();
  if (config_.show) Show(now);
}

void TeleopApp::TakeStatus() {
  const auto message = status_.Take();
  if (!message) return;
  newest_ = *message;
  robot_ = FromMessage(*message, base_.session);
}

void TeleopApp::Send(const PilotOutput& output, Time now) {
  const auto next = [](Sender& sender) -> const Sender& {
    sender.sequence = (sender.sequence + 1) & 0xffff;
    return sender;
  };
  const double time_to_live_s = config_.pilot.time_to_live_s;
  // A stop goes first, and a lease is asked for before it is used.
  if (output.estop) estop_.Publish(ToMessage(*output.estop, now));
  if (output.lease) lease_.Publish(ToMessage(*output.lease, base_, now));
  if (output.drive) drive_.Publish(ToMessage(*output.drive, next(base_), time_to_live_s, now));
  if (output.head) head_drive_.Publish(ToMessage(*output.head, next(head_), time_to_live_s, now));
}

void TeleopApp::ReportPhase() {
  if (reported_ == pilot_.phase()) return;
  const bool was_gone = reported_ == PilotPhase::kNoDevice;
  reported_ = pilot_.phase();
  if (reported_ == PilotPhase::kNoDevice) {
    context_.SetHealth(bus::Health::kDegraded, device_->Describe());
    context_.Log(bus::Level::kWarning, device_->Describe());
  } else {
    context_.SetHealth(bus::Health::kOk);
    if (was_gone) context_.Log(bus::Level::kInfo, device_->Describe());
  }
}

void TeleopApp::Show(Time now) {
  if (shown_ && now - *shown_ < kShowPeriod) return;
  const bool first = !shown_;
  shown_ = now;
  TerminalView view;
  view.device = device_->Describe();
  view.stick = stick_;
  view.phase = pilot_.phase();
  view.mode = pilot_.mode();
  view.fast = pilot_.fast();
  view.wish = pilot_.wish();
  view.head_wish = pilot_.head_wish();
  view.buttons = config_.pilot.buttons;
  view.uses = Uses(config_.pilot, pilot_.mode());
  if (newest_) {
    view.answer_age_s = Seconds(now - FromUtime(newest_->utime));
    Describe(*newest_, base_.session, view);
  }
  std::string text = Draw(view);
  if (config_.device == "keyboard") text += std::string(kKeyHelp) + "\n";
  // Home, and every line cleared to its end: no flicker.
  std::string screen = first ? "\033[2J\033[H" : "\033[H";
  for (const char c : text) screen += c == '\n' ? std::string("\033[K\n") : std::string(1, c);
  std::cout << screen << "\033[J" << std::flush;
}

}  // namespace priamos::teleop
