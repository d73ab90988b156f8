#include "robot/robot_app.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace priamos::robot {
namespace {

/// Why a path is not driven; empty when it is.
std::string_view Refusal(PathVerdict verdict) {
  switch (verdict) {
    case PathVerdict::kWithoutLease:
      return "another driver holds the lease";
    case PathVerdict::kEstop:
      return "the e-stop is pressed";
    case PathVerdict::kStale:
      return "it was ordered before the e-stop was pressed or re-armed; next: order it again";
    case PathVerdict::kTaken:
    case PathVerdict::kSame:
      break;
  }
  return "";
}

}  // namespace

RobotApp::RobotApp(const RobotConfig& config, bus::Context& context)
    : config_(config),
      context_(context),
      last_word_(config.state_file.empty() ? "" : context.ResolvePath(config.state_file)),
      localiser_(config.localiser, config.base),
      drive_(config.drive, config.base),
      wheels_(context.node().SubscribeAll(channels::kWheelState)),
      sonars_(context.node().Subscribe(channels::kSonarRanges)),
      floor_lines_(context.node().SubscribeAll(channels::kObstacleLine)),
      paths_(context.node().SubscribeAll(channels::kPath)),
      fixes_(context.node().SubscribeAll(channels::kLandmarkFix)),
      commands_(context.node().SubscribeAll(channels::kDriveCommand)),
      lease_requests_(context.node().SubscribeAll(channels::kLeaseRequest)),
      estops_(context.node().SubscribeAll(channels::kEstop)),
      healths_(context.node().SubscribeAll(channels::kHealth)),
      link_(context.node().Subscribe(channels::kLinkStatus)),
      wheel_command_(context.node().Advertise(channels::kWheelCommand)),
      odometry_(context.node().Advertise(channels::kOdometry)),
      pose_(context.node().Advertise(channels::kPose)),
      status_(context.node().Advertise(channels::kDriveStatus)),
      correction_(context.node().Advertise(channels::kPoseCorrection)) {
  why_latched_ = WhyLatched(last_word_.Load());
  if (!why_latched_.empty()) drive_.PressEstop();
}

RobotApp::~RobotApp() {
  if (!running_) return;
  try {
    last_word_.Save(drive_.estop() ? LastWord::kEstop : LastWord::kEnded);
  } catch (const std::exception& error) {
    context_.Log(bus::Level::kError, error.what());
  }
}

/// Begins the work with the first tick: an App that is only asked for its interface writes nothing.
void RobotApp::Begin(Time now) {
  running_ = true;
  drive_.CountEstopChangesFrom(static_cast<int>(ToUtime(now) / 1'000'000 % 256));
  last_word_.Save(drive_.estop() ? LastWord::kEstop : LastWord::kRunning);
  if (why_latched_.empty()) return;
  context_.Log(bus::Level::kWarning, fmt::format("the e-stop is latched: {}; re-arm to drive", why_latched_));
}

void RobotApp::Tick(Time now) {
  if (!running_) Begin(now);
  TakeEstops(now);
  TakeWheels(now);
  TakeSonars();
  TakeFloorLines(now);
  TakeFixes(now);
  AnswerFixes(now);
  TakeSignsOfLife(now);
  TakeLeaseRequests(now);
  TakePaths(now);
  TakeCommands(now);
  Drive(now);
  KeepEstop(now);
  SendStatus(now);
}

void RobotApp::Yield(Time now) {
  if (commands_wheels_) wheel_command_.Publish(ToMessage(WheelSpeeds{}, context_.claimant(), now));
}

void RobotApp::TakeWheels(Time now) {
  bool moved = false;
  for (const wheel_state_t& message : wheels_.Drain()) {
    if (bool(message.contested) != contested_) ReportContest(message);
    if (!localiser_.AddWheels(FromMessage(message), now)) continue;
    wheels_heard_ = now;
    moved = true;
  }
  if (moved) odometry_.Publish(ToMessage(localiser_.odometry()));
}

void RobotApp::TakeSonars() {
  if (const auto message = sonars_.Take())
    drive_.AddSonar(FromMessage(*message), localiser_.odometry().pose());
}

/// The base has moved on since the picture.
void RobotApp::TakeFloorLines(Time now) {
  for (const obstacle_line_t& message : floor_lines_.Drain()) {
    const auto line = FromMessage(message);
    if (line && drive_.AddFloorLine(*line, localiser_.OdometryPoseAt(line->exposure), now)) continue;
    ++floor_lines_refused_;
    context_.Log(bus::Level::kWarning,
                 fmt::format("obstacle line refused, the {}. one: {}", floor_lines_refused_,
                             line ? "too old, of a time to come, or repeated" : "numbers out of range"));
  }
}

void RobotApp::TakeFixes(Time now) {
  for (const landmark_fix_t& message : fixes_.Drain()) {
    if (const auto fix = FromMessage(message)) {
      localiser_.AddFix(*fix, now);
    } else {
      correction_.Publish(NotFound(message, now));
    }
  }
}

void RobotApp::AnswerFixes(Time now) {
  for (const Localiser::Answer& answer : localiser_.Step(now)) {
    const FixResult& result = answer.result;
    if (result.verdict == FixVerdict::kApplied) {
      context_.Log(bus::Level::kInfo,
                   fmt::format("fix {}: corrected by {:.3f} m, {:.2f} deg; distance {:.1f}",
                               answer.fix.request_id, std::hypot(result.change.x, result.change.y),
                               Degrees(result.change.yaw), result.distance));
    } else {
      context_.Log(bus::Level::kWarning,
                   fmt::format("fix {} refused: {}", answer.fix.request_id, result.reason));
    }
    // A repeated message has had its answer.
    if (result.verdict != FixVerdict::kDouble) correction_.Publish(ToMessage(answer, now));
  }
}

bool RobotApp::IsOlder(std::int64_t utime, double most_s, Time now) const {
  return Seconds(now - FromUtime(utime)) > most_s;
}

void RobotApp::TakeEstops(Time now) {
  for (const estop_t& message : estops_.Drain()) {
    if (message.action == estop_t::STOP) {
      drive_.PressEstop();
    } else if (message.action == estop_t::REARM && !IsOlder(message.utime, config_.order_max_age_s, now)) {
      Rearm();
    } else {
      context_.Log(bus::Level::kWarning, "re-arming refused: too old, or no such action");
    }
  }
}

/// First the file, then the drive: a re-arming that is forgotten is better than one too many.
void RobotApp::Rearm() {
  try {
    last_word_.Save(LastWord::kRunning);
  } catch (const std::exception& error) {
    return context_.Log(bus::Level::kError, fmt::format("not re-armed: {}", error.what()));
  }
  drive_.Rearm();
  context_.Log(bus::Level::kInfo, "re-armed; a new order is needed to move");
}

/// After the order to stand was sent to the wheels: a slow disk delays nothing.
void RobotApp::KeepEstop(Time now) {
  if (!drive_.estop() || (keep_again_ && now < *keep_again_)) return;
  try {
    last_word_.Save(LastWord::kEstop);
  } catch (const std::exception& error) {
    keep_again_ = now + std::chrono::seconds(1);
    context_.Log(bus::Level::kError, fmt::format("a restart would forget the e-stop: {}", error.what()));
  }
}

void RobotApp::TakeLeaseRequests(Time now) {
  for (const lease_request_t& message : lease_requests_.Drain()) {
    const auto request = FromMessage(message);
    if (!request || IsOlder(message.utime, config_.order_max_age_s, now)) {
      context_.Log(bus::Level::kWarning, "lease request refused: too old, or nobody that is known");
      continue;
    }
    drive_.RequestLease(request->who, request->wish, now);
  }
}

void RobotApp::TakeCommands(Time now) {
  for (const drive_command_t& message : commands_.Drain()) drive_.SetCommand(FromMessage(message), now);
}

void RobotApp::TakeSignsOfLife(Time now) {
  for (const health_t& message : healths_.Drain())
    if (message.process == "head") head_heard_ = now;
  // A robot without a radio hears of no link, and has none to lose.
  const link_status_t* link = link_.get();
  const bool down = link && (!link->up || link_.Age(now) > channels::kLinkStatus.stale_after);
  if (!down) link_down_since_.reset();
  if (down && !link_down_since_) link_down_since_ = now;
}

void RobotApp::TakePaths(Time now) {
  for (const path_t& message : paths_.Drain()) {
    const auto path = FromMessage(message);
    std::string_view refusal;
    if (!path) {
      refusal = "not drivable";
    } else if (!path->points.empty() && IsOlder(message.utime, config_.path_max_age_s, now)) {
      refusal = "too old";
    } else {
      refusal = Refusal(drive_.SetPath(*path, now));
    }
    if (!refusal.empty())
      context_.Log(bus::Level::kWarning, fmt::format("path {} refused: {}", message.path_id, refusal));
  }
}

void RobotApp::Drive(Time now) {
  const auto estimate = localiser_.estimate();
  const Duration link_down =
      link_down_since_ ? std::max(now - *link_down_since_, Duration(1)) : Duration::zero();
  const auto speeds =
      drive_.Step({estimate, localiser_.odometry().pose(), wheels_heard_, head_heard_, link_down}, now);
  commands_wheels_ = speeds.has_value();
  if (speeds) wheel_command_.Publish(ToMessage(*speeds, context_.claimant(), now));
  if (estimate) pose_.Publish(ToMessage(*estimate));
  Report(drive_.state());
}

void RobotApp::SendStatus(Time now) {
  if (status_sent_ && Seconds(now - *status_sent_) < 1 / config_.status_rate_hz - 1e-6) return;
  status_sent_ = now;
  const auto estimate = localiser_.estimate();
  const double speed_m_s = estimate ? std::hypot(estimate->twist.vx, estimate->twist.vy) : 0;
  status_.Publish(ToMessage(drive_.state(), speed_m_s, now));
}

void RobotApp::ReportContest(const wheel_state_t& message) {
  contested_ = message.contested;
  context_.Log(bus::Level::kWarning,
               contested_
                   ? fmt::format("the drive board holds the wheels: another process commands them, too; "
                                 "{} of its commands were not obeyed",
                                 message.foreign_commands)
                   : "the wheels are commanded by one process again");
}

void RobotApp::Report(const DriveState& state) {
  if (state.holder != reported_holder_) {
    reported_holder_ = state.holder;
    context_.Log(
        bus::Level::kInfo,
        fmt::format("the lease is {}", state.holder.driver == Driver::kNobody
                                           ? "free"
                                           : fmt::format("held by {}, session {}", Text(state.holder.driver),
                                                         state.holder.session)));
  }
  const auto cause = state.failsafe.cause;
  if (cause == reported_cause_) return;
  reported_cause_ = cause;
  if (!cause) {
    context_.SetHealth(bus::Health::kOk);
    context_.Log(bus::Level::kInfo, "nothing stops the base any more");
    return;
  }
  context_.SetHealth(bus::Health::kDegraded, Text(*cause));
  context_.Log(bus::Level::kWarning, fmt::format("the base is stopped: {}", Text(*cause)));
}

}  // namespace priamos::robot
