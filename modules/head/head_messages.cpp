#include "head/head_messages.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "common/covariance.hpp"

namespace priamos::head {
namespace {

constexpr double kMinEdge_m = 0.02;
constexpr double kMaxGreyRatio = 3;  // logarithm
constexpr std::size_t kMaxViewEdges = 28;
constexpr int kMaxLeftOut = 255;
constexpr std::size_t kMaxPieces = 4, kMaxPiecesLeftOut = 63;
constexpr double kHighest_m = 2.5, kMostSigmaYaw_rad = 0.63;

bool AllFinite(std::initializer_list<double> values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

/// Standard deviations of a place across and along its own axes: x, y.
Eigen::Vector2d OwnSigmas(const TrackedPlace& place) {
  const Eigen::Matrix2d turn = place.map_from_thing.rotation();
  return (turn.transpose() * place.covariance * turn).diagonal().cwiseMax(0).cwiseSqrt();
}

view_edge_t ToMessage(const ViewedEdge& edge) {
  view_edge_t message{};
  message.kind = static_cast<std::int8_t>(edge.kind);
  message.u1_px = static_cast<float>(edge.p.x());
  message.v1_px = static_cast<float>(edge.p.y());
  message.u2_px = static_cast<float>(edge.q.x());
  message.v2_px = static_cast<float>(edge.q.y());
  return message;
}

obstacle_segment_t ToMessage(const ObstaclePiece& piece) {
  obstacle_segment_t message{};
  message.kind = static_cast<std::int8_t>(piece.kind);
  message.x1_m = static_cast<float>(piece.right.x());
  message.y1_m = static_cast<float>(piece.right.y());
  message.x2_m = static_cast<float>(piece.left.x());
  message.y2_m = static_cast<float>(piece.left.y());
  message.height_m = static_cast<float>(piece.height_m);
  message.sigma_height_m = static_cast<float>(piece.sigma_height_m);
  return message;
}

constexpr int kLast = 1000;

/// The pieces that matter most, as they lie from right to left: the highest of each line in turn, so that a
/// wall on the far line does not hide a duct on the near one.
std::vector<ObstaclePiece> MostImportant(const std::vector<ObstaclePiece>& pieces, std::size_t n) {
  std::vector<std::size_t> order(pieces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto weight = [&](std::size_t i) {
    return pieces[i].kind == ObstaclePiece::kMissing ? 0 : std::abs(pieces[i].height_m);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return weight(a) > weight(b); });
  std::vector<int> rank(pieces.size());
  std::map<int, int> taken;
  for (const std::size_t i : order)
    rank[i] = pieces[i].kind == ObstaclePiece::kMissing ? kLast : taken[pieces[i].laser]++;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return rank[i]; });
  order.resize(std::min(n, order.size()));
  std::sort(order.begin(), order.end());
  std::vector<ObstaclePiece> chosen;
  chosen.reserve(order.size());
  for (const std::size_t i : order) chosen.push_back(pieces[i]);
  return chosen;
}

}  // namespace

HeadReport FromMessage(const head_state_t& message) {
  HeadReport report{FromUtime(message.utime), {}, message.moving != 0};
  report.setting.pan_rad = message.pan_rad;
  report.setting.tilt_rad = message.tilt_rad;
  for (int i = 0; i < 2; ++i) {
    report.setting.vergence_rad[i] = message.vergence_rad[i];
    report.setting.zoom_step[i] = message.zoom_step[i];
    report.setting.focus_step[i] = message.focus_step[i];
  }
  return report;
}

FrameNotice FromMessage(const camera_frame_t& message) {
  return {FromUtime(message.utime_exposure),
          message.frame_id,
          message.camera,
          message.slot,
          message.width_px,
          message.height_px};
}

LookOrder FromMessage(const look_request_t& message) {
  return {message.request_id, message.landmark_id, std::clamp<int>(message.side, 0, 2)};
}

std::optional<PoseSample> FromMessage(const pose_t& m) {
  if (!AllFinite({m.x_m, m.y_m, m.yaw_rad, m.vx_m_s, m.vy_m_s, m.wz_rad_s, m.sigma_x_m, m.sigma_y_m,
                  m.sigma_yaw_rad, m.rho_x_y, m.rho_x_yaw, m.rho_y_yaw})) {
    return std::nullopt;
  }
  return PoseSample{FromUtime(m.utime),
                    {m.x_m, m.y_m, WrapAngle(m.yaw_rad)},
                    {m.vx_m_s, m.vy_m_s, m.wz_rad_s},
                    CovarianceIn(m)};
}

std::optional<LandmarkModel> FromMessage(const landmark_model_t& message) {
  if (!AllFinite({message.x_m, message.y_m, message.yaw_rad})) return std::nullopt;
  LandmarkModel model{message.landmark_id, {message.x_m, message.y_m, WrapAngle(message.yaw_rad)}, {}};
  for (const landmark_edge_t& e : message.edges) {
    if (!AllFinite({e.x1_m, e.y1_m, e.z1_m, e.x2_m, e.y2_m, e.z2_m, e.visible_from_rad, e.visible_to_rad,
                    e.grey_ratio})) {
      return std::nullopt;
    }
    LandmarkEdge edge{
        {e.x1_m, e.y1_m, e.z1_m}, {e.x2_m, e.y2_m, e.z2_m}, e.visible_from_rad, e.visible_to_rad, e.side};
    if (e.grey_ratio != 0) edge.grey_ratio = std::clamp<double>(e.grey_ratio, -kMaxGreyRatio, kMaxGreyRatio);
    if ((edge.to - edge.from).norm() > kMinEdge_m) model.edges.push_back(edge);
  }
  return model;
}

HeadWish FromMessage(const head_drive_t& message) {
  HeadWish wish;
  wish.time = FromUtime(message.utime);
  const bool credible = message.time_to_live_s > 0 && message.time_to_live_s < 1;
  wish.time_to_live = credible ? FromSeconds(message.time_to_live_s) : Duration::zero();
  wish.session = message.session;
  wish.sequence = message.sequence;
  wish.pan_rad_s = message.pan_rad_s;
  wish.tilt_rad_s = message.tilt_rad_s;
  wish.vergence_rad_s = message.vergence_rad_s;
  wish.zoom_step_s = message.zoom_step_s;
  wish.focus_step_s = message.focus_step_s;
  return wish;
}

HeadAim FromMessage(const head_aim_t& message) {
  const auto step = [](int value) { return value < 0 ? std::nullopt : std::optional(value); };
  HeadAim aim{FromUtime(message.utime), message.pan_rad,         message.tilt_rad, std::nullopt,
              step(message.zoom_step),  step(message.focus_step)};
  if (!(message.vergence_rad < 0)) aim.vergence_rad = message.vergence_rad;
  return aim;
}

head_command_t ToMessage(const HeadSetting& setting, Time now) {
  head_command_t message{};
  message.utime = ToUtime(now);
  message.pan_rad = setting.pan_rad;
  message.tilt_rad = setting.tilt_rad;
  for (int i = 0; i < 2; ++i) {
    message.vergence_rad[i] = setting.vergence_rad[i];
    message.zoom_step[i] = static_cast<std::int16_t>(setting.zoom_step[i]);
    message.focus_step[i] = static_cast<std::int16_t>(setting.focus_step[i]);
  }
  return message;
}

camera_trigger_t TriggerMessage(std::int32_t frame_id, int cameras, Time now) {
  camera_trigger_t message{};
  message.utime = ToUtime(now);
  message.frame_id = frame_id;
  message.cameras = static_cast<std::int8_t>(cameras);
  return message;
}

landmark_fix_t ToMessage(const LookAnswer& answer) {
  landmark_fix_t message{};
  message.utime_exposure = ToUtime(answer.exposure);
  message.request_id = answer.order.request_id;
  message.landmark_id = static_cast<std::int16_t>(answer.order.landmark_id);
  message.side = static_cast<std::int8_t>(answer.order.side);
  message.verdict = static_cast<std::int8_t>(answer.fix.verdict);
  message.model_x_m = answer.map_from_landmark.x;
  message.model_y_m = answer.map_from_landmark.y;
  message.model_yaw_rad = answer.map_from_landmark.yaw;
  message.n_matched = static_cast<std::int16_t>(std::min(answer.fix.n_matched, 255));
  message.residual_px = std::min(answer.fix.residual_px, 20.0);
  if (answer.fix.verdict != Verdict::kFound) return message;
  message.x_m = answer.fix.base_from_landmark.x;
  message.y_m = answer.fix.base_from_landmark.y;
  message.yaw_rad = answer.fix.base_from_landmark.yaw;
  const SigmaRho s = ToSigmaRho(answer.fix.covariance);
  message.sigma_x_m = std::min(s.sigma_x, 1.0);
  message.sigma_y_m = std::min(s.sigma_y, 1.0);
  message.sigma_yaw_rad = std::min(s.sigma_yaw, 0.5);
  message.own_share = static_cast<float>(std::clamp(answer.fix.own_share, 0.0, 1.0));
  message.rho_x_y = s.rho_x_y;
  message.rho_x_yaw = s.rho_x_yaw;
  message.rho_y_yaw = s.rho_y_yaw;
  return message;
}

std::optional<door_seen_t> DoorSeenMessage(const LookAnswer& answer) {
  if (!answer.leaf) return std::nullopt;
  door_seen_t message{};
  message.utime_exposure = ToUtime(answer.exposure);
  message.request_id = answer.order.request_id;
  message.landmark_id = static_cast<std::int16_t>(answer.order.landmark_id);
  message.hinge = static_cast<std::int8_t>(answer.leaf->hinge);
  message.open_rad = answer.leaf->open_rad;
  message.sigma_rad = std::min(answer.leaf->sigma_rad, 0.5);
  message.log_odds = std::clamp(answer.leaf->log_odds, -40.0, 40.0);
  return message;
}

door_found_t ToMessage(const DoorTrack& door, DoorState state) {
  door_found_t message{};
  const Pose2& place = door.place.map_from_thing;
  message.utime_seen = ToUtime(door.seen);
  message.id = static_cast<std::int16_t>(door.id);
  message.x_m = place.x;
  message.y_m = place.y;
  message.yaw_rad = place.yaw;
  message.width_m = door.width_m;
  const Eigen::Vector2d sigma = OwnSigmas(door.place);
  message.sigma_across_m = sigma.x();
  message.sigma_along_m = sigma.y();
  message.state = static_cast<std::int8_t>(state);
  message.log_odds = std::min(door.state.Lead(), 31.0);
  message.looks = static_cast<std::int8_t>(std::min(door.looks, 63));
  return message;
}

scene_object_t ToMessage(const SceneTrack& track, bool has_gone) {
  scene_object_t message{};
  const Pose2& place = track.place.map_from_thing;
  const SceneObject& object = track.object;
  message.utime_seen = ToUtime(track.seen);
  message.id = static_cast<std::int16_t>(track.id);
  message.kind = static_cast<std::int8_t>(object.kind);
  message.x_m = place.x;
  message.y_m = place.y;
  message.yaw_rad = place.yaw;
  message.width_m = object.width_m;
  message.depth_m = object.depth_m;
  message.bottom_m = std::clamp(object.bottom_m, 0.0, kHighest_m);
  message.top_m = std::clamp(object.top_m, 0.0, kHighest_m);
  const Eigen::Vector2d sigma = OwnSigmas(track.place);
  message.sigma_across_m = sigma.x();
  message.sigma_along_m = sigma.y();
  message.sigma_yaw_rad = std::min(object.sigma_yaw_rad, kMostSigmaYaw_rad);
  message.looks = static_cast<std::int8_t>(has_gone ? 0 : std::min(track.looks, 63));
  return message;
}

landmark_view_t ViewMessage(const LookAnswer& answer) {
  landmark_view_t message{};
  message.utime_exposure = ToUtime(answer.exposure);
  message.request_id = answer.order.request_id;
  message.landmark_id = static_cast<std::int16_t>(answer.order.landmark_id);
  message.side = static_cast<std::int8_t>(answer.order.side);
  message.verdict = static_cast<std::int8_t>(answer.fix.verdict);
  message.camera = static_cast<std::int8_t>(answer.view.camera);
  const std::size_t n = std::min(answer.view.edges.size(), kMaxViewEdges);
  const int left_out = answer.view.n_left_out + static_cast<int>(answer.view.edges.size() - n);
  message.n_left_out = static_cast<std::int16_t>(std::min(left_out, kMaxLeftOut));
  message.n_edges = static_cast<std::int8_t>(n);
  for (std::size_t i = 0; i < n; ++i) message.edges.push_back(ToMessage(answer.view.edges[i]));
  return message;
}

obstacle_line_t ToMessage(const ObstacleLines& lines, Time exposure) {
  obstacle_line_t message{};
  message.utime_exposure = ToUtime(exposure);
  message.verdict = static_cast<std::int8_t>(lines.verdict);
  message.seen_share = static_cast<float>(lines.seen_share);
  const auto chosen = MostImportant(lines.pieces, kMaxPieces);
  message.n_left_out =
      static_cast<std::int8_t>(std::min(lines.pieces.size() - chosen.size(), kMaxPiecesLeftOut));
  message.n_segments = static_cast<std::int8_t>(chosen.size());
  for (const ObstaclePiece& piece : chosen) message.segments.push_back(ToMessage(piece));
  return message;
}

ObstacleLines FromMessage(const obstacle_line_t& message) {
  ObstacleLines lines;
  lines.verdict = static_cast<ObstacleLines::Verdict>(std::clamp<int>(message.verdict, 0, 2));
  lines.seen_share = message.seen_share;
  for (const obstacle_segment_t& s : message.segments) {
    if (s.kind < obstacle_segment_t::UP || s.kind > obstacle_segment_t::MISSING) continue;
    lines.pieces.push_back({static_cast<ObstaclePiece::Kind>(s.kind),
                            {s.x1_m, s.y1_m, s.height_m},
                            {s.x2_m, s.y2_m, s.height_m},
                            s.height_m,
                            s.sigma_height_m});
  }
  return lines;
}

LandmarkView FromMessage(const landmark_view_t& message) {
  LandmarkView view;
  view.camera = message.camera == 1 ? 1 : 0;
  view.n_left_out = message.n_left_out;
  for (const view_edge_t& e : message.edges) {
    if (e.kind < view_edge_t::PREDICTED || e.kind > view_edge_t::REJECTED) continue;
    view.edges.push_back({static_cast<ViewedEdge::Kind>(e.kind), {e.u1_px, e.v1_px}, {e.u2_px, e.v2_px}});
  }
  return view;
}

}  // namespace priamos::head
