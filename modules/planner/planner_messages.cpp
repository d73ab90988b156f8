#include "planner/planner_messages.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/covariance.hpp"

namespace priamos::planner {
namespace {

DriveMode ModeOf(int mode) {
  switch (mode) {
    case drive_status_t::FOLLOWING:
      return DriveMode::kFollowing;
    case drive_status_t::ARRIVED:
      return DriveMode::kArrived;
    case drive_status_t::HOLDING:
      return DriveMode::kHolding;
    case drive_status_t::BLOCKED:
      return DriveMode::kBlocked;
    default:
      return DriveMode::kIdle;
  }
}

landmark_edge_t ToMessage(const LandmarkEdge& edge) {
  landmark_edge_t message{};
  message.x1_m = edge.from.x();
  message.y1_m = edge.from.y();
  message.z1_m = edge.from.z();
  message.x2_m = edge.to.x();
  message.y2_m = edge.to.y();
  message.z2_m = edge.to.z();
  message.visible_from_rad = static_cast<float>(edge.visible_from_rad);
  message.visible_to_rad = static_cast<float>(edge.visible_to_rad);
  message.side = static_cast<std::int8_t>(edge.side);
  message.grey_ratio = static_cast<float>(edge.grey_ratio.value_or(0));
  return message;
}

std::optional<ThingNear> NearestOf(const drive_status_t& message) {
  if (!(message.nearest_m >= 0)) return std::nullopt;
  return ThingNear{message.nearest_m, {message.nearest_x_m, message.nearest_y_m}};
}

}  // namespace

RobotPose FromMessage(const pose_t& message) {
  return {FromUtime(message.utime),
          {message.x_m, message.y_m, message.yaw_rad},
          {message.vx_m_s, message.vy_m_s, message.wz_rad_s},
          CovarianceIn(message)};
}

/// A robot that has touched something has dropped its path; one that somebody walked into keeps it.
DriveReport FromMessage(const drive_status_t& message) {
  const bool bumped = message.limit == drive_status_t::LIMIT_TOUCHED &&
                      (message.mode == drive_status_t::FOLLOWING || message.mode == drive_status_t::BLOCKED);
  return {ModeOf(message.mode),
          message.path_id,
          bumped ? "somebody touched the standing robot" : std::string(DriveLimitText(message.limit)),
          message.estop != 0,
          message.estop_changes,
          message.limit == drive_status_t::LIMIT_TOUCHED && !bumped,
          message.remaining_m,
          NearestOf(message),
          message.driver == lease_request_t::TELEOP || message.driver == lease_request_t::CONSOLE,
          message.limit == drive_status_t::LIMIT_SONAR};
}

PassedOpening FromMessage(const opening_t& message) {
  return {FromUtime(message.utime), {message.x_m, message.y_m, message.yaw_rad}, message.width_m};
}

LeafSighting FromMessage(const door_seen_t& message) {
  LeafSighting leaf{FromUtime(message.utime_exposure),
                    message.landmark_id,
                    "",
                    message.open_rad,
                    message.sigma_rad,
                    message.log_odds};
  if (message.hinge == door_seen_t::LEFT) leaf.hinge = "left";
  if (message.hinge == door_seen_t::RIGHT) leaf.hinge = "right";
  return leaf;
}

std::optional<LookResult> FromMessage(const landmark_fix_t& message) {
  if (message.verdict == landmark_fix_t::FOUND) return std::nullopt;
  LookResult result{message.request_id, false, std::string(FixVerdictText(message.verdict)),
                    message.verdict == landmark_fix_t::NO_MODEL};
  result.elsewhere = message.verdict == landmark_fix_t::ELSEWHERE;
  return result;
}

LookResult FromMessage(const pose_correction_t& message) {
  const bool applied = message.verdict == pose_correction_t::APPLIED;
  return {message.request_id,
          applied,
          applied ? "" : std::string(CorrectionVerdictText(message.verdict)),
          false,
          message.verdict == pose_correction_t::IMPLAUSIBLE,
          message.verdict == pose_correction_t::RESET,
          false};
}

landmark_model_t ToMessage(const Landmark& landmark) {
  if (landmark.edges.size() > std::size_t(kMaxLandmarkEdges))
    throw std::invalid_argument("a landmark has more than 20 edges");
  landmark_model_t message{};
  message.landmark_id = static_cast<std::int16_t>(landmark.id);
  message.x_m = landmark.map_from_landmark.x;
  message.y_m = landmark.map_from_landmark.y;
  message.yaw_rad = landmark.map_from_landmark.yaw;
  message.n_edges = static_cast<std::int8_t>(landmark.edges.size());
  for (const LandmarkEdge& edge : landmark.edges) message.edges.push_back(ToMessage(edge));
  return message;
}

path_t ToMessage(const PathOrder& path, Time now) {
  if (path.points.size() > kMostPathPoints) throw std::invalid_argument("a path has more than 16 points");
  path_t message{};
  message.utime = ToUtime(now);
  message.path_id = path.path_id;
  message.estop_changes = static_cast<std::int16_t>(path.estop_changes);
  message.speed_m_s = path.speed_m_s;
  message.centre = path.centre;
  message.n_points = static_cast<std::int8_t>(path.points.size());
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const Pose2& point = path.points[i];
    path_point_t corner{};
    corner.x_m = point.x;
    corner.y_m = point.y;
    corner.yaw_rad = point.yaw;
    if (i < path.leeway.size()) {
      corner.left_m = path.leeway[i].left_m;
      corner.right_m = path.leeway[i].right_m;
    }
    message.points.push_back(corner);
  }
  return message;
}

plan_walls_t ToMessage(const std::vector<WallFace>& faces, double sigma_m) {
  constexpr double kMostLength_m = 102.3;
  if (faces.size() > kMostFaces) throw std::invalid_argument("more than 3 walls along a path");
  plan_walls_t message{};
  message.n_walls = static_cast<std::int8_t>(faces.size());
  for (const WallFace& face : faces) {
    plan_wall_t wall{};
    wall.x_m = face.from.x();
    wall.y_m = face.from.y();
    wall.yaw_rad = std::atan2(face.along().y(), face.along().x());
    wall.length_m = std::min(face.length_m(), kMostLength_m);
    wall.sigma_m = face.sigma_m > 0 ? face.sigma_m : sigma_m;
    message.walls.push_back(wall);
  }
  return message;
}

look_request_t ToMessage(const LookOrder& look, Time now) {
  look_request_t message{};
  message.utime = ToUtime(now);
  message.request_id = look.request_id;
  message.landmark_id = static_cast<std::int16_t>(look.landmark_id);
  message.side = static_cast<std::int8_t>(look.side);
  return message;
}

pose_reset_t ToMessage(const PlaceOrder& place, Time now) {
  pose_reset_t message{};
  message.utime = ToUtime(now);
  message.request_id = place.request_id;
  message.x_m = place.map_from_base.x;
  message.y_m = place.map_from_base.y;
  message.yaw_rad = place.map_from_base.yaw;
  message.sigma_m = place.sigma_m;
  message.sigma_yaw_rad = place.sigma_yaw_rad;
  return message;
}

std::string_view FixVerdictText(int verdict) {
  switch (verdict) {
    case landmark_fix_t::FOUND:
      return "found";
    case landmark_fix_t::NO_MODEL:
      return "the head has no model of it";
    case landmark_fix_t::NO_POSE:
      return "the head has no pose";
    case landmark_fix_t::NO_IMAGE:
      return "no image";
    case landmark_fix_t::NOT_VISIBLE:
      return "not visible from there";
    case landmark_fix_t::TOO_FEW_EDGES:
      return "too few edges";
    case landmark_fix_t::AMBIGUOUS:
      return "ambiguous";
    case landmark_fix_t::RESIDUAL_TOO_LARGE:
      return "the edges do not fit the model";
    case landmark_fix_t::ELSEWHERE:
      return "found elsewhere than it can be";
    default:
      return "unknown verdict";
  }
}

std::string_view CorrectionVerdictText(int verdict) {
  switch (verdict) {
    case pose_correction_t::APPLIED:
      return "applied";
    case pose_correction_t::NOT_FOUND:
      return "not found";
    case pose_correction_t::TOO_OLD:
      return "the fix came too late for the robot";
    case pose_correction_t::IMPLAUSIBLE:
      return "the robot found the fix implausible";
    case pose_correction_t::RESET:
      return "the pose was set by order";
    case pose_correction_t::MOVING:
      return "the base was moving";
    default:
      return "unknown verdict";
  }
}

std::string_view DriveLimitText(int limit) {
  switch (limit) {
    case drive_status_t::LIMIT_NONE:
      return "";
    case drive_status_t::LIMIT_SONAR:
      return "an echo is too near";
    case drive_status_t::LIMIT_POSE_STALE:
      return "the pose is too uncertain or too old";
    case drive_status_t::LIMIT_WHEELS_SILENT:
      return "the wheels do not answer";
    case drive_status_t::LIMIT_SONAR_SILENT:
      return "the sonars are silent";
    case drive_status_t::LIMIT_WHEELS_STUCK:
      return "the wheels are stuck";
    case drive_status_t::LIMIT_HEAD_SILENT:
      return "the head is silent";
    case drive_status_t::LIMIT_LINK_LOST:
      return "the radio link is lost";
    case drive_status_t::LIMIT_OPERATOR_SILENT:
      return "the operator is silent";
    case drive_status_t::LIMIT_LEASE_LOST:
      return "the lease is lost";
    case drive_status_t::LIMIT_ESTOP:
      return "the emergency stop was pressed";
    case drive_status_t::LIMIT_TOUCHED:
      return "the robot touched something";
    case drive_status_t::LIMIT_BUMPER_SILENT:
      return "the bumper is silent";
    default:
      return "unknown limit";
  }
}

}  // namespace priamos::planner
