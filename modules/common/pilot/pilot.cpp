#include "common/pilot/pilot.hpp"

#include <algorithm>
#include <cmath>

namespace priamos {
namespace {

constexpr Duration kAskAgain = std::chrono::seconds(1);
/// The robot keeps a lease for some seconds after the last command; within this it surely still has ours.
constexpr Duration kSurelyKept = std::chrono::milliseconds(1500);
/// For how long a robot that cannot be heard is told to stand: within it, it has taken the lease back itself.
constexpr Duration kTellEnd = std::chrono::seconds(10);

/// Change of a wish that counts as a jump, as a share of the wish at full deflection.
constexpr double kJump = 0.15;

double Deflection(const Stick& stick, const AxisUse& use) {
  const auto at = std::find(kAxisNames.begin(), kAxisNames.end(), use.axis) - kAxisNames.begin();
  const double value = stick.axis[static_cast<std::size_t>(at) % kAxes];
  return use.inverted ? -value : value;
}

}  // namespace

Pilot::Pilot(const PilotConfig& config)
    : config_(config),
      base_sender_(FromSeconds(1 / config.rate_hz), FromSeconds(1 / config.rest_rate_hz)),
      head_sender_(FromSeconds(1 / config.rate_hz), Duration::max()) {}

PilotOutput Pilot::Step(const Stick& stick, const RobotView& robot, Time now) {
  PilotOutput output;
  UseButtons(stick, robot, now, output);
  const bool drove = phase_ == PilotPhase::kDriving;
  phase_ = NextPhase(stick, robot, now);
  if (drove && phase_ != PilotPhase::kDriving) ended_ = now;
  if (phase_ == PilotPhase::kAsking) Ask(now, output);
  Wish(stick);
  Send(stick, robot, now, output);
  before_ = stick;
  return output;
}

/// True at the moment a button goes down. What was held when the device came is not pressed.
bool Pilot::Pressed(const Stick& stick, int button) const {
  return before_.connected && stick.connected && IsPressed(stick, button) && !IsPressed(before_, button);
}

void Pilot::UseButtons(const Stick& stick, const RobotView& robot, Time now, PilotOutput& output) {
  UseEstopButtons(stick, robot, now, output);
  if (Pressed(stick, config_.buttons.range)) fast_ = !fast_;
  if (Pressed(stick, config_.buttons.take_over)) {
    output.lease = PilotOutput::Lease::kTakeOver;
    asked_again_ = now;
  }
  if (!Pressed(stick, config_.buttons.mode)) return;
  mode_ = mode_ == PilotMode::kBase ? PilotMode::kHead : PilotMode::kBase;
  // A stick that is deflected now would move what it was not meant for.
  if (!AtRest(stick) && phase_ != PilotPhase::kIdle) phase_ = PilotPhase::kMustLetGo;
}

void Pilot::UseEstopButtons(const Stick& stick, const RobotView& robot, Time now, PilotOutput& output) {
  const ButtonUse& buttons = config_.buttons;
  if (Pressed(stick, buttons.estop)) {
    stop_.Order();
    phase_ = PilotPhase::kMustLetGo;
  }
  if (stop_.Step(robot.estop, now)) output.estop = PilotOutput::Estop::kStop;
  const bool rearming = stick.connected && IsPressed(stick, buttons.rearm) && AtRest(stick) &&
                        !IsPressed(stick, buttons.dead_man) && !IsPressed(stick, buttons.estop);
  if (!rearming) rearm_since_.reset();
  if (!rearming) return;
  if (Pressed(stick, buttons.rearm)) rearm_since_ = now;
  if (!rearm_since_ || now - *rearm_since_ < FromSeconds(config_.rearm_hold_s)) return;
  output.estop = PilotOutput::Estop::kRearm;
  rearm_since_.reset();
  stop_.Forget();
}

bool Pilot::LeaseIsOurs(const RobotView& robot, Time now) const {
  if (!robot.heard || now - *robot.heard > FromSeconds(config_.status_stale_s)) return false;
  if (robot.lease != RobotView::Lease::kMine || robot.estop) return false;
  const bool surely_kept = base_sender_.last() && now - *base_sender_.last() < kSurelyKept;
  return phase_ == PilotPhase::kDriving || surely_kept || (asked_ && *robot.heard >= *asked_);
}

PilotPhase Pilot::NextPhase(const Stick& stick, const RobotView& robot, Time now) {
  using enum PilotPhase;
  const bool was_refused = WasRefused(robot);
  if (!stick.connected) return kNoDevice;
  const bool held = IsPressed(stick, config_.buttons.dead_man);
  if (!held) return kIdle;
  if (phase_ == kMustLetGo || phase_ == kNoDevice) return kMustLetGo;
  if (phase_ == kIdle) {
    // What is held while the e-stop is latched must be let go after it was lifted.
    if (robot.estop || stop_.pending() || !AtRest(before_)) return kMustLetGo;
    asked_ = now;
    asked_again_.reset();
    return LeaseIsOurs(robot, now) ? kDriving : kAsking;
  }
  if (phase_ == kDriving && was_refused) return kMustLetGo;
  if (LeaseIsOurs(robot, now)) return kDriving;
  if (robot.estop) return kMustLetGo;
  return phase_ == kDriving ? kMustLetGo : kAsking;
}

/// Whether the robot refused motion since the step before: it heard nothing of this hand for a while.
bool Pilot::WasRefused(const RobotView& robot) {
  if (!robot.heard) return false;
  const bool more = refused_ && robot.refused != *refused_;
  refused_ = robot.refused;
  return more && robot.refuses_motion;
}

void Pilot::Ask(Time now, PilotOutput& output) {
  if (output.lease || (asked_again_ && now - *asked_again_ < kAskAgain)) return;
  output.lease = PilotOutput::Lease::kAcquire;
  asked_again_ = now;
}

void Pilot::Wish(const Stick& stick) {
  const auto shaped = [&](const AxisUse& use) { return config_.shape(Deflection(stick, use)); };
  const SpeedRange& range = fast_ ? config_.fast : config_.slow;
  const BaseAxes& base = config_.base;
  double x = shaped(base.vx), y = shaped(base.vy);
  // Full deflection along both axes is not faster than along one.
  const double size = std::hypot(x, y);
  if (size > 1) {
    x /= size;
    y /= size;
  }
  wish_ = {x * range.speed_m_s, y * range.speed_m_s, shaped(base.turn) * range.turn_rad_s};
  const HeadAxes& head = config_.head;
  head_wish_ = {shaped(head.pan) * head.pan_rad_s, shaped(head.tilt) * head.tilt_rad_s,
                shaped(head.vergence) * head.vergence_rad_s, shaped(head.zoom) * head.zoom_step_s,
                shaped(head.focus) * head.focus_step_s};
}

bool Pilot::AtRest(const Stick& stick) const {
  return std::all_of(stick.axis.begin(), stick.axis.end(),
                     [this](double v) { return config_.shape(v) == 0; });
}

bool Pilot::EndIsUnheard(const RobotView& robot, Time now) const {
  return ended_ && robot.heard && *robot.heard <= *ended_ && now - *ended_ < kTellEnd;
}

void Pilot::Send(const Stick& stick, const RobotView& robot, Time now, PilotOutput& output) {
  const bool talks = now - stick.heard <= FromSeconds(config_.silence_s);
  const bool may = phase_ == PilotPhase::kDriving && talks;
  const bool base = mode_ == PilotMode::kBase, head = mode_ == PilotMode::kHead;
  const bool moves_base = may && base && (wish_.vx != 0 || wish_.vy != 0 || wish_.wz != 0);
  const bool moves_head = may && head && head_wish_ != HeadRates{};
  if (!moves_base) wish_ = {};
  if (!moves_head) head_wish_ = {};
  // While asking, the robot is to hear commands to stand as often as possible: the first one it accepts ends
  // the wait.
  const bool in_hand =
      phase_ == PilotPhase::kDriving || phase_ == PilotPhase::kAsking || EndIsUnheard(robot, now);
  const auto state = moves_base || phase_ == PilotPhase::kAsking ? WishSender::Stick::kDeflected
                     : in_hand                                   ? WishSender::Stick::kHeld
                                                                 : WishSender::Stick::kReleased;
  if (base_sender_.Step(state, Jumped(), now)) output.drive = sent_ = wish_;
  if (head_sender_.Step(moves_head ? WishSender::Stick::kDeflected : WishSender::Stick::kReleased, false,
                        now))
    output.head = head_wish_;
}

/// A hand that moves on slowly can wait for its turn, one that changes its mind not.
bool Pilot::Jumped() const {
  const SpeedRange& range = fast_ ? config_.fast : config_.slow;
  return std::hypot(wish_.vx - sent_.vx, wish_.vy - sent_.vy) > kJump * range.speed_m_s ||
         std::abs(wish_.wz - sent_.wz) > kJump * range.turn_rad_s;
}

}  // namespace priamos
