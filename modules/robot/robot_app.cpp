#include "robot/robot_app.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace priamos::robot {
namespace {

/// Longest time in which a touch is noticed, and the least that is added to the pose's uncertainty by one.
constexpr double kTouchNoticed_s = 0.25, kLeastSlip_m = 0.02, kLeastSlip_rad = Radians(1.0);

/// How often and how long the newest opening is repeated.
constexpr double kOpeningRate_hz = 1;
constexpr Duration kOpeningRepeated = std::chrono::seconds(60);

/// Why a path is not driven; empty when it is.
std::string_view Refusal(PathVerdict verdict) {
  switch (verdict) {
    case PathVerdict::kWithoutLease:
      return "another driver holds the lease";
    case PathVerdict::kEstop:
      return "the e-stop is pressed";
    case PathVerdict::kStale:
      return "it was ordered before the e-stop was pressed or re-armed; next: order it again";
    case PathVerdict::kTouched:
      return "the base has just touched something; next: order it again";
    case PathVerdict::kTaken:
    case PathVerdict::kSame:
      break;
  }
  return "";
}

/// What somebody has to do after a crash, beside re-arming.
constexpr const char* kSayWhere =
    ", and say where it stands with priamos place, or have it look with priamos mission locate";

/// After a crash the base may be anywhere near: where it started no longer counts. So far off a planner takes
/// it for lost, and its walls and doors for no proof of where it is.
LocaliserConfig StartAfter(const EstopMemory& memory, LocaliserConfig config) {
  constexpr double kAnywhere_m = 3, kAnyhow_deg = 45;
  if (!memory.crashed()) return config;
  config.estimator.initial.position_error_m = kAnywhere_m;
  config.estimator.initial.yaw_error_deg = kAnyhow_deg;
  return config;
}

}  // namespace

RobotApp::RobotApp(const RobotConfig& config, bus::Context& context)
    : config_(config),
      context_(context),
      estop_memory_(config.state_file.empty() ? "" : context.ResolvePath(config.state_file)),
      status_rate_(config.status_rate_hz),
      opening_rate_(kOpeningRate_hz),
      localiser_(StartAfter(estop_memory_, config.localiser), config.base, config.drive.footprint),
      drive_(config.drive, config.base),
      opening_watch_(config.opening, config.drive.footprint),
      features_(config, context),
      corrector_(config, context),
      reporter_(context),
      wheels_(context.node().SubscribeAll(channels::kWheelState)),
      currents_(context.node().SubscribeAll(channels::kMotorCurrent)),
      bumper_(context.node().SubscribeAll(channels::kBumper)),
      sonars_(context.node().Subscribe(channels::kSonarRanges)),
      floor_lines_(context.node().SubscribeAll(channels::kObstacleLine)),
      things_(context.node().SubscribeAll(channels::kSceneObject)),
      paths_(context.node().SubscribeAll(channels::kPath)),
      plan_walls_(context.node().SubscribeAll(channels::kPlanWalls)),
      commands_(context.node().SubscribeAll(channels::kDriveCommand)),
      lease_requests_(context.node().SubscribeAll(channels::kLeaseRequest)),
      estops_(context.node().SubscribeAll(channels::kEstop)),
      healths_(context.node().SubscribeAll(channels::kHealth)),
      link_(context.node().Subscribe(channels::kLinkStatus)),
      wheel_command_(context.node().Advertise(channels::kWheelCommand)),
      odometry_(context.node().Advertise(channels::kOdometry)),
      pose_(context.node().Advertise(channels::kPose)),
      status_(context.node().Advertise(channels::kDriveStatus)),
      opening_(context.node().Advertise(channels::kOpening)) {
  if (!estop_memory_.why_latched().empty()) drive_.PressEstop();
}

RobotApp::~RobotApp() {
  if (!running_) return;
  try {
    estop_memory_.End(drive_.estop());
  } catch (const std::exception& error) {
    context_.Log(bus::Level::kError, error.what());
  }
}

/// Begins the work with the first tick: an App that is only asked for its interface writes nothing.
void RobotApp::Begin(Time now) {
  running_ = true;
  drive_.CountEstopChangesFrom(now);
  estop_memory_.Begin(drive_.estop());
  if (const auto& why = estop_memory_.why_latched(); !why.empty())
    context_.Log(bus::Level::kWarning, fmt::format("the e-stop is latched: {}; re-arm to drive{}", why,
                                                   estop_memory_.crashed() ? kSayWhere : ""));
}

void RobotApp::Tick(Time now) {
  if (!running_) Begin(now);
  TakeEstops(now);
  TakeWheels(now);
  TakeTouchSensors(now);
  MapSonars(now);
  TakeSonars();
  TakeFloorLines(now);
  TakeSeenThings();
  corrector_.Tick(localiser_, drive_, now);
  TakeSignsOfLife(now);
  TakeLeaseRequests(now);
  TakePlanWalls();
  TakePaths(now);
  TakeCommands(now);
  Drive(now);
  KeepEstop(now);
  SendStatus(now);
  SendOpening(now);
  features_.Tick(localiser_, now);
}

void RobotApp::Yield(Time now) {
  if (commands_wheels_) wheel_command_.Publish(ToMessage(WheelSpeeds{}, context_.claimant(), now));
}

void RobotApp::TakeWheels(Time now) {
  bool moved = false;
  for (const wheel_state_t& message : wheels_.Drain()) {
    reporter_.Report(message);
    if (!localiser_.AddWheels(FromMessage(message), now)) continue;
    wheels_heard_ = now;
    drive_.touch_watch().AddMotion(*localiser_.odometry().time(), localiser_.odometry().twist());
    moved = true;
  }
  if (moved) odometry_.Publish(ToMessage(localiser_.odometry()));
}

void RobotApp::TakeTouchSensors(Time now) {
  for (const motor_current_t& message : currents_.Drain())
    if (const auto currents = FromMessage(message)) drive_.touch_watch().AddCurrents(*currents);
  for (const bumper_t& message : bumper_.Drain())
    drive_.touch_watch().AddBumper(static_cast<std::uint8_t>(message.pressed), now);
}

/// Walls in the step after a cycle was heard, corners and edges in the next: all in one would be the longest
/// step.
void RobotApp::MapSonars(Time now) {
  if (!to_map_) return features_.HearPoints(localiser_, now);
  for (const FoundSegment* found : features_.Hear(*to_map_, localiser_, now)) {
    const WallSegment& wall = found->wall;
    drive_.AddWall(found->number, {wall.from(), wall.to(), std::sqrt(wall.line().covariance(0, 0))});
  }
  to_map_.reset();
}

void RobotApp::TakeSonars() {
  const auto message = sonars_.Take();
  if (!message) return;
  const SonarCycle cycle = FromMessage(*message);
  const Pose2& odom_from_base = localiser_.odometry().pose();
  drive_.AddSonar(cycle, odom_from_base);
  localiser_.AddSonar(cycle);
  to_map_ = cycle;
  const auto estimate = localiser_.estimate();
  if (!estimate) return;
  if (const auto opening = opening_watch_.Add(cycle, odom_from_base, estimate->pose)) {
    passed_ = *opening;
    opening_rate_ = RateLimit(kOpeningRate_hz);
  }
}

/// Repeated, because on the radio it is a state: it gets there after a blackout, too.
void RobotApp::SendOpening(Time now) {
  if (!passed_ || now - passed_->time > kOpeningRepeated || !opening_rate_.Due(now)) return;
  opening_rate_.Mark(now);
  opening_.Publish(ToMessage(*passed_));
}

/// Adds each line at the pose that the base had when its picture was taken.
void RobotApp::TakeFloorLines(Time now) {
  for (const obstacle_line_t& message : floor_lines_.Drain()) {
    const auto line = FromMessage(message);
    if (line && drive_.AddFloorLine(*line, localiser_.OdometryPoseAt(line->exposure), now)) continue;
    ++floor_lines_refused_;
    context_.LogRefusal(
        channels::kObstacleLine.name,
        fmt::format("obstacle line refused, the {}. one: {}", floor_lines_refused_,
                    line ? "too old, of a time to come, or repeated" : "numbers out of range"));
  }
}

/// The head tells places of the map as the base knows it, so from here on they move with the odometry.
void RobotApp::TakeSeenThings() {
  for (const scene_object_t& message : things_.Drain()) {
    const auto thing = FromMessage(message);
    const auto estimate = localiser_.estimate();
    if (!thing)
      context_.LogRefusal(channels::kSceneObject.name,
                          fmt::format("thing {} of the head refused: numbers out of range", message.id));
    if (thing && estimate)
      drive_.AddSeenThing(*thing, localiser_.odometry().pose() * estimate->pose.Inverse());
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
      context_.LogRefusal(channels::kEstop.name, "re-arming refused: too old, or no such action");
    }
  }
}

void RobotApp::Rearm() {
  if (const std::string why = estop_memory_.Forget(); !why.empty())
    return context_.Log(bus::Level::kError, fmt::format("not re-armed: {}", why));
  drive_.Rearm();
  context_.Log(bus::Level::kInfo, "re-armed; a new order is needed to move");
}

/// Writes a latched e-stop down, after the order to stand was sent to the wheels: a slow disk delays nothing.
void RobotApp::KeepEstop(Time now) {
  if (!drive_.estop()) return;
  if (const std::string why = estop_memory_.Keep(now); !why.empty())
    context_.Log(bus::Level::kError, fmt::format("a restart would forget the e-stop: {}", why));
}

void RobotApp::TakeLeaseRequests(Time now) {
  for (const lease_request_t& message : lease_requests_.Drain()) {
    const auto request = FromMessage(message);
    if (!request || IsOlder(message.utime, config_.order_max_age_s, now)) {
      context_.LogRefusal(channels::kLeaseRequest.name,
                          "lease request refused: too old, or nobody that is known");
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
  link_watch_.Update(down, now);
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
      context_.LogRefusal(channels::kPath.name, fmt::format("path {} refused: {}", message.path_id, refusal));
  }
}

void RobotApp::TakePlanWalls() {
  for (const plan_walls_t& message : plan_walls_.Drain()) {
    auto walls = FromMessage(message);
    if (!walls) {
      context_.LogRefusal(channels::kPlanWalls.name, "walls of the plan refused: numbers out of range");
      continue;
    }
    localiser_.SetPlan(std::move(*walls));
  }
}

void RobotApp::Drive(Time now) {
  const auto estimate = localiser_.estimate();
  const auto speeds = drive_.Step(
      {estimate, localiser_.odometry().pose(), wheels_heard_, head_heard_, link_watch_.DownFor(now)}, now);
  ReportTouch(now);
  commands_wheels_ = speeds.has_value();
  if (speeds) wheel_command_.Publish(ToMessage(*speeds, context_.claimant(), now));
  if (estimate) pose_.Publish(ToMessage(*estimate));
  reporter_.Report(drive_.state());
}

void RobotApp::SendStatus(Time now) {
  if (!status_rate_.Due(now)) return;
  status_rate_.Mark(now);
  const auto estimate = localiser_.estimate();
  const double speed_m_s = estimate ? std::hypot(estimate->twist.vx, estimate->twist.vy) : 0;
  status_.Publish(ToMessage(drive_.state(), speed_m_s, now));
}

/// The wheels turned on while the base was held: as far as they went before it was noticed.
void RobotApp::ReportTouch(Time now) {
  const auto& touch = drive_.state().touch;
  if (!touch || touch->time != now) return;
  const Twist2 twist = localiser_.odometry().twist();
  localiser_.AddSlip(kLeastSlip_m + std::hypot(twist.vx, twist.vy) * kTouchNoticed_s,
                     kLeastSlip_rad + std::abs(twist.wz) * kTouchNoticed_s);
  reporter_.Report(*touch);
}

}  // namespace priamos::robot
