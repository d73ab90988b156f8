#include "robot/robot_messages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/covariance.hpp"
#include "robot/message_codes.hpp"

namespace priamos::robot {
namespace {

constexpr double kMapReach = 100;
constexpr double kLeastSpeed = 0.01;

bool IsOnMap(const path_point_t& point) {
  return std::abs(point.x_m) <= kMapReach && std::abs(point.y_m) <= kMapReach && std::isfinite(point.yaw_rad);
}

/// Within the bounds of path_point_t.lcm; written so that NaN is refused.
bool IsLeeway(double metres) {
  return metres >= 0 && metres <= 3.1;
}

Eigen::Matrix3d CovarianceOf(const landmark_fix_t& m) {
  const auto is_sigma = [](double s) { return s >= 0 && std::isfinite(s); };
  const auto is_rho = [](double r) { return std::abs(r) <= 1; };
  const bool credible = is_sigma(m.sigma_x_m) && is_sigma(m.sigma_y_m) && is_sigma(m.sigma_yaw_rad) &&
                        is_rho(m.rho_x_y) && is_rho(m.rho_x_yaw) && is_rho(m.rho_y_yaw);
  if (!credible) return Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN());
  return CovarianceIn(m);
}

/// Whether a segment is within the bounds of obstacle_segment_t.lcm; written so that NaN is refused.
bool IsCredible(const obstacle_segment_t& s) {
  const auto is_place = [](double x, double y) { return x >= 0 && x <= 10.23 && std::abs(y) <= 5.12; };
  return s.kind >= obstacle_segment_t::UP && s.kind <= obstacle_segment_t::MISSING &&
         is_place(s.x1_m, s.y1_m) && is_place(s.x2_m, s.y2_m) && std::abs(s.height_m) <= 1.28 &&
         s.sigma_height_m >= 0 && s.sigma_height_m <= 0.255F;
}

}  // namespace

WheelSample FromMessage(const wheel_state_t& message) {
  WheelSample sample{.time = FromUtime(message.utime)};
  std::copy(std::begin(message.position_ticks), std::end(message.position_ticks), sample.ticks.begin());
  sample.deadline_stopped = message.deadline_stopped != 0;
  return sample;
}

std::optional<MotorCurrents> FromMessage(const motor_current_t& message) {
  for (const double current : message.current_a)
    if (!std::isfinite(current)) return std::nullopt;
  MotorCurrents currents{.time = FromUtime(message.utime)};
  std::copy(std::begin(message.current_a), std::end(message.current_a), currents.current_a.begin());
  return currents;
}

SonarCycle FromMessage(const sonar_ranges_t& message) {
  SonarCycle cycle{.time = FromUtime(message.utime)};
  std::copy(std::begin(message.range_m), std::end(message.range_m), cycle.range_m.begin());
  return cycle;
}

std::optional<Path> FromMessage(const path_t& message) {
  const bool drivable = message.n_points == 0 || message.speed_m_s >= kLeastSpeed;
  if (!drivable || !std::isfinite(message.speed_m_s)) return std::nullopt;
  Path path{.id = message.path_id,
            .speed_m_s = message.speed_m_s,
            .points = {},
            .leeway = {},
            .centre = message.centre != 0,
            .estop_changes = message.estop_changes};
  if (path.centre && message.n_points > 1) return std::nullopt;
  for (const path_point_t& point : message.points) {
    if (!IsOnMap(point) || !IsLeeway(point.left_m) || !IsLeeway(point.right_m)) return std::nullopt;
    path.points.push_back({point.x_m, point.y_m, WrapAngle(point.yaw_rad)});
    path.leeway.push_back({point.left_m, point.right_m});
  }
  return path;
}

std::optional<std::vector<PlanWall>> FromMessage(const plan_walls_t& message) {
  constexpr double kLeastLength_m = 0.05, kMostLength_m = 102.3, kLeastSigma_m = 0.001, kMostSigma_m = 0.32;
  std::vector<PlanWall> walls;
  for (const plan_wall_t& wall : message.walls) {
    const bool good = std::abs(wall.x_m) <= kMapReach && std::abs(wall.y_m) <= kMapReach &&
                      std::isfinite(wall.yaw_rad) && wall.length_m >= kLeastLength_m &&
                      wall.length_m <= kMostLength_m && wall.sigma_m >= kLeastSigma_m &&
                      wall.sigma_m <= kMostSigma_m;
    if (!good) return std::nullopt;
    const Pose2 from{wall.x_m, wall.y_m, WrapAngle(wall.yaw_rad)};
    walls.push_back({from.translation(), from * Eigen::Vector2d(wall.length_m, 0), wall.sigma_m});
  }
  return walls;
}

std::optional<LandmarkFix> FromMessage(const landmark_fix_t& message) {
  if (message.verdict != landmark_fix_t::FOUND) return std::nullopt;
  LandmarkFix fix;
  fix.exposure = FromUtime(message.utime_exposure);
  fix.request_id = message.request_id;
  fix.base_from_landmark = {message.x_m, message.y_m, WrapAngle(message.yaw_rad)};
  fix.covariance = CovarianceOf(message);
  fix.own_share = message.own_share;
  fix.map_from_landmark = {message.model_x_m, message.model_y_m, WrapAngle(message.model_yaw_rad)};
  return fix;
}

std::optional<FloorLine> FromMessage(const obstacle_line_t& message) {
  if (message.verdict < obstacle_line_t::CLEAR || message.verdict > obstacle_line_t::BLIND)
    return std::nullopt;
  FloorLine line{FromUtime(message.utime_exposure), {}};
  for (const obstacle_segment_t& s : message.segments) {
    if (!IsCredible(s)) return std::nullopt;
    if (s.kind != obstacle_segment_t::MISSING)
      line.pieces.push_back({{s.x1_m, s.y1_m}, {s.x2_m, s.y2_m}, s.height_m});
  }
  return line;
}

std::optional<SeenThing> FromMessage(const scene_object_t& m) {
  constexpr double kMap_m = 100, kYaw = 3.15, kSize_m = 5.1, kHeight_m = 2.5, kSigma_m = 0.63;
  const auto within = [](double value, double low, double high) { return value >= low && value <= high; };
  const bool good = within(m.kind, scene_object_t::EDGE, scene_object_t::BOX) &&
                    within(m.x_m, -kMap_m, kMap_m) && within(m.y_m, -kMap_m, kMap_m) &&
                    within(m.yaw_rad, -kYaw, kYaw) && within(m.width_m, 0, kSize_m) &&
                    within(m.depth_m, 0, kSize_m) && within(m.bottom_m, 0, kHeight_m) &&
                    within(m.top_m, m.bottom_m, kHeight_m) && within(m.sigma_along_m, 0, kSigma_m) &&
                    within(m.sigma_across_m, 0, kSigma_m) && m.looks >= 0;
  if (!good) return std::nullopt;
  SeenThing thing;
  thing.id = m.id;
  thing.seen = FromUtime(m.utime_seen);
  thing.is_edge = m.kind == scene_object_t::EDGE;
  thing.has_gone = m.looks == 0;
  thing.map_from_front = {m.x_m, m.y_m, m.yaw_rad};
  thing.width_m = m.width_m;
  thing.depth_m = m.kind == scene_object_t::BOX ? m.depth_m : 0;
  thing.bottom_m = m.bottom_m;
  thing.top_m = m.top_m;
  thing.sigma_m = std::max(m.sigma_along_m, m.sigma_across_m);
  return thing;
}

DriveCommand FromMessage(const drive_command_t& message) {
  DriveCommand command;
  command.time = FromUtime(message.utime);
  // Somebody unknown holds no lease, so the command is refused and counted like any without one.
  command.from = {DriverOf(message.driver).value_or(Driver::kNobody), message.session};
  command.sequence = message.sequence;
  const bool credible = message.time_to_live_s > 0 && message.time_to_live_s < 1;
  command.time_to_live = credible ? FromSeconds(message.time_to_live_s) : Duration::zero();
  command.twist = {message.vx_m_s, message.vy_m_s, message.wz_rad_s};
  return command;
}

std::optional<LeaseRequest> FromMessage(const lease_request_t& message) {
  const auto driver = DriverOf(message.driver);
  const auto wish = WishOf(message.action);
  if (!driver || !wish) return std::nullopt;
  return LeaseRequest{{*driver, message.session}, *wish};
}

wheel_command_t ToMessage(const WheelSpeeds& speeds, std::int32_t instance, Time now) {
  wheel_command_t message{};
  message.utime = ToUtime(now);
  message.instance = instance;
  std::copy(speeds.begin(), speeds.end(), std::begin(message.speed_rad_s));
  return message;
}

odometry_t ToMessage(const Odometry& odometry) {
  odometry_t message{};
  message.utime = odometry.time() ? ToUtime(*odometry.time()) : 0;
  message.x_m = odometry.pose().x;
  message.y_m = odometry.pose().y;
  message.yaw_rad = odometry.pose().yaw;
  message.vx_m_s = odometry.twist().vx;
  message.vy_m_s = odometry.twist().vy;
  message.wz_rad_s = odometry.twist().wz;
  message.slip_m_s = odometry.slip_m_s();
  return message;
}

pose_t ToMessage(const PoseEstimate& estimate) {
  const SigmaRho s = ToSigmaRho(estimate.covariance);
  pose_t message{};
  message.utime = ToUtime(estimate.time);
  message.x_m = estimate.pose.x;
  message.y_m = estimate.pose.y;
  message.yaw_rad = estimate.pose.yaw;
  message.vx_m_s = estimate.twist.vx;
  message.vy_m_s = estimate.twist.vy;
  message.wz_rad_s = estimate.twist.wz;
  message.sigma_x_m = s.sigma_x;
  message.sigma_y_m = s.sigma_y;
  message.sigma_yaw_rad = s.sigma_yaw;
  message.rho_x_y = s.rho_x_y;
  message.rho_x_yaw = s.rho_x_yaw;
  message.rho_y_yaw = s.rho_y_yaw;
  return message;
}

drive_status_t ToMessage(const DriveState& state, double speed_m_s, Time now) {
  drive_status_t message{};
  message.utime = ToUtime(now);
  message.mode = ModeCode(state.mode);
  message.limit = state.slowed_by_sonar ? drive_status_t::LIMIT_SONAR : drive_status_t::LIMIT_NONE;
  if (state.bumped) message.limit = drive_status_t::LIMIT_TOUCHED;
  if (state.halted_by) message.limit = LimitCode(*state.halted_by);
  if (state.failsafe.cause) message.limit = LimitCode(*state.failsafe.cause);
  message.path_id = state.path_id;
  message.remaining_m = state.remaining_m;
  message.cross_track_m = state.cross_track_m;
  message.speed_m_s = speed_m_s;
  const auto nearest = state.nearest.value_or(CollisionStop::Nearest{.free_m = -1});
  message.nearest_m = nearest.free_m;
  message.nearest_x_m = nearest.point.x();
  message.nearest_y_m = nearest.point.y();
  message.allowed = state.allowed;
  message.driver = DriverCode(state.holder.driver);
  message.session = static_cast<std::int16_t>(state.holder.session);
  message.estop = state.estop;
  message.estop_changes = static_cast<std::int16_t>(state.estop_changes);
  message.refused = state.refused_commands;
  message.refusal = RefusalCode(state.refusal);
  return message;
}

pose_correction_t ToMessage(const Localiser::Answer& answer, Time now) {
  const FixResult& result = answer.result;
  pose_correction_t message{};
  message.utime = ToUtime(now);
  message.utime_exposure = ToUtime(answer.fix.exposure);
  message.request_id = answer.fix.request_id;
  message.verdict = VerdictCode(result.verdict);
  message.dx_m = result.change.x;
  message.dy_m = result.change.y;
  message.dyaw_rad = result.change.yaw;
  message.sigma_m = result.at_picture.PositionSigma();
  message.sigma_yaw_rad = result.at_picture.YawSigma();
  message.distance = result.distance;
  return message;
}

opening_t ToMessage(const Opening& opening) {
  opening_t message{};
  message.utime = ToUtime(opening.time);
  message.x_m = opening.map_from_base.x;
  message.y_m = opening.map_from_base.y;
  message.yaw_rad = opening.map_from_base.yaw;
  message.width_m = opening.width_m;
  return message;
}

pose_correction_t NotFound(const landmark_fix_t& fix, Time now) {
  pose_correction_t message{};
  message.utime = ToUtime(now);
  message.utime_exposure = fix.utime_exposure;
  message.request_id = fix.request_id;
  message.verdict = pose_correction_t::NOT_FOUND;
  return message;
}

std::optional<KnownPose> FromMessage(const pose_reset_t& message) {
  constexpr double kMap_m = 100, kMost_m = 2, kMost_rad = 1.6;
  const auto within = [](double value, double least, double most) { return value >= least && value <= most; };
  const bool good = within(message.x_m, -kMap_m, kMap_m) && within(message.y_m, -kMap_m, kMap_m) &&
                    within(message.yaw_rad, -3.15, 3.15) && within(message.sigma_m, 0.001, kMost_m) &&
                    within(message.sigma_yaw_rad, 0.001, kMost_rad);
  if (!good) return std::nullopt;
  return KnownPose{
      {message.x_m, message.y_m, WrapAngle(message.yaw_rad)}, message.sigma_m, message.sigma_yaw_rad};
}

pose_correction_t AnswerTo(const pose_reset_t& order, int verdict, const Pose2& change, Time now) {
  pose_correction_t message{};
  message.utime = message.utime_exposure = ToUtime(now);
  message.request_id = order.request_id;
  message.verdict = static_cast<std::int8_t>(verdict);
  message.dx_m = change.x;
  message.dy_m = change.y;
  message.dyaw_rad = change.yaw;
  message.sigma_m = order.sigma_m;
  message.sigma_yaw_rad = order.sigma_yaw_rad;
  return message;
}

std::string_view Text(Condition condition) {
  for (const FailsafeRule& rule : FailsafeRules({}))
    if (rule.condition == condition) return rule.meaning;
  return "";
}

std::string_view Text(Driver driver) {
  switch (driver) {
    case Driver::kNobody:
      break;
    case Driver::kPlanner:
      return "the planner";
    case Driver::kConsole:
      return "the console";
    case Driver::kTeleop:
      return "teleop";
  }
  return "nobody";
}

}  // namespace priamos::robot
