#include "console/foxglove/scene.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "bus/schema/text_codec.hpp"
#include "common/robot/robot_drawing.hpp"
#include "common/sonar_ring.hpp"
#include "console/core/valid_time.hpp"
#include "console/foxglove/scene_parts.hpp"
#include "console/foxglove/scene_schemas.hpp"

namespace priamos::console {
namespace {

using Json = Scene::Json;

constexpr Colour kWall{0.45, 0.5, 0.56, 0.5}, kNoGo{0.85, 0.47, 0.06, 0.4}, kWood{0.75, 0.5, 0.2, 0.9},
    kRobotBlue{0.04, 0.36, 0.72, 1}, kPathViolet{0.48, 0.18, 0.71, 1}, kExpected{0.55, 0.6, 0.65, 1},
    kFound{0.1, 0.65, 0.3, 1}, kDanger{0.8, 0.1, 0.12, 1};
constexpr double kNoGoHeight_m = 0.02;
constexpr double kWallHeight_m = 1.0;  ///< cut off, so that one sees into the rooms
constexpr double kSonarHeight_m = 0.4;
constexpr double kSigmas = 3;
constexpr int kFoundVerdict = 0;
constexpr std::size_t kMostModels = 100;
constexpr int kFloat32 = 7, kPointList = 4;  // foxglove.NumericType, foxglove.PointsAnnotationType

/// A number of a message; nullopt when it is none, as NaN is.
std::optional<double> NumberOf(const Json& object, const char* key) {
  const auto it = object.is_object() ? object.find(key) : object.end();
  if (it == object.end() || !it->is_number()) return std::nullopt;
  return it->get<double>();
}

/// A small whole number of a message, such as a landmark's; nullopt when it is none.
std::optional<int> SmallOf(const Json& object, const char* key) {
  const auto value = NumberOf(object, key);
  if (!value || *value < 0 || *value > 999) return std::nullopt;
  return static_cast<int>(*value);
}

/// All of these numbers, or none.
template <std::size_t N>
std::optional<std::array<double, N>> NumbersOf(const Json& object, const std::array<const char*, N>& keys) {
  std::array<double, N> values{};
  for (std::size_t i = 0; i < N; ++i) {
    const auto value = NumberOf(object, keys[i]);
    if (!value) return std::nullopt;
    values[i] = *value;
  }
  return values;
}

std::optional<Pose2> PoseOf(const Json& object,
                            const std::array<const char*, 3>& keys = {"x_m", "y_m", "yaw_rad"}) {
  const auto values = NumbersOf(object, keys);
  if (!values) return std::nullopt;
  return Pose2{(*values)[0], (*values)[1], (*values)[2]};
}

const Json& ListOf(const Json& object, const char* key) {
  static const Json kNothing = Json::array();
  const auto it = object.is_object() ? object.find(key) : object.end();
  return it == object.end() || !it->is_array() ? kNothing : *it;
}

/// The ellipse of kSigmas standard deviations around the base centre, in the map.
Points Ellipse(const Pose2& pose, double sigma_x, double sigma_y, double rho) {
  constexpr int kCorners = 36;
  // Cholesky factor of the covariance.
  const double c = sigma_y * rho, d = sigma_y * std::sqrt(std::max(0.0, 1 - rho * rho));
  Points points;
  for (int i = 0; i <= kCorners; ++i) {
    const double u = kSigmas * std::cos(2 * M_PI * i / kCorners),
                 v = kSigmas * std::sin(2 * M_PI * i / kCorners);
    points.emplace_back(pose.x + sigma_x * u, pose.y + c * u + d * v, 0.01);
  }
  return points;
}

/// Edges of a landmark's skeleton, two points each, in the landmark's frame.
Points Skeleton(const Json& model) {
  Points points;
  for (const Json& edge : ListOf(model, "edges")) {
    const auto v = NumbersOf<6>(edge, {"x1_m", "y1_m", "z1_m", "x2_m", "y2_m", "z2_m"});
    if (!v) continue;
    points.emplace_back((*v)[0], (*v)[1], (*v)[2]);
    points.emplace_back((*v)[3], (*v)[4], (*v)[5]);
  }
  return points;
}

Json SkeletonEntity(const std::string& id, const EntityFrame& frame, const Pose2& pose, const Json& model,
                    const Colour& colour, Time time) {
  Json lines = LinesJson(Skeleton(model), colour, true, 0.015);
  lines["pose"] = PoseJson(pose);
  Json entity = EntityJson(id, frame, time);
  entity["lines"].push_back(std::move(lines));
  return entity;
}

std::string PackedPoints(const Points& points) {
  std::vector<std::byte> bytes(points.size() * 3 * sizeof(float));
  std::size_t at = 0;
  for (const Eigen::Vector3d& point : points)
    for (int i = 0; i < 3; ++i, at += sizeof(float)) {
      const float value = static_cast<float>(point[i]);
      std::memcpy(bytes.data() + at, &value, sizeof value);
    }
  return bus::ToBase64(bytes);
}

}  // namespace

Scene::Json Scene::Picture(std::string_view jpeg, Time exposed) {
  return {{"timestamp", StampJson(exposed)},
          {"frame_id", "third"},
          {"data", bus::ToBase64(std::as_bytes(std::span(jpeg)))},
          {"format", "jpeg"}};
}

std::vector<Scene::Topic> Scene::Topics() {
  return {{kTransform, kFrameTransform, {"POSE"}},
          {kPlan, kSceneUpdate, {}},
          {kRobot, kSceneUpdate, {"POSE"}},
          {kPath, kSceneUpdate, {"PATH"}},
          {kEchoes, kPointCloud, {"SONAR_RANGES"}},
          {kLandmarks, kSceneUpdate, {"LANDMARK_MODEL", "LANDMARK_FIX"}},
          {kView, kImageAnnotations, {"LANDMARK_VIEW"}},
          {kObstacles, kSceneUpdate, {"OBSTACLE_LINE"}}};
}

std::string_view Scene::SchemaOf(std::string_view topic) {
  for (const Topic& one : Topics())
    if (one.name == topic) return one.schema;
  return {};
}

std::vector<Scene::Message> Scene::Hear(std::string_view channel, const Json& message, Time arrival) {
  const Time valid = ValidTime(message, arrival);
  if (channel == "POSE") return Pose(message, valid);
  if (channel == "PATH") return Path(message, valid);
  if (channel == "SONAR_RANGES") return Sonars(message, valid);
  if (channel == "LANDMARK_MODEL") return Model(message, valid);
  if (channel == "LANDMARK_FIX") return Fix(message, valid);
  if (channel == "LANDMARK_VIEW") return View(message, valid);
  if (channel == "OBSTACLE_LINE") return Obstacles(message, valid);
  return {};
}

Scene::Message Scene::Plan(const GroundPlan& plan, Time now) {
  Json entity = EntityJson("plan", {}, now);
  for (const WallPlan& wall : plan.walls) {
    const Rectangle shape = wall.Shape();
    entity["cubes"].push_back(
        BoxJson(shape.map_from_centre, {2 * shape.half_m.x(), 2 * shape.half_m.y(), kWallHeight_m}, kWall));
  }
  for (const CupboardPlan& cupboard : plan.cupboards) {
    const Pose2 centre = cupboard.map_from_cupboard() * Pose2{cupboard.depth_m / 2, 0, 0};
    entity["cubes"].push_back(
        BoxJson(centre, {cupboard.depth_m, cupboard.width_m, cupboard.height_m}, kWood));
  }
  for (const NoGoPlan& area : plan.no_go) {
    const Rectangle shape = area.Shape();
    entity["cubes"].push_back(
        BoxJson(shape.map_from_centre, {2 * shape.half_m.x(), 2 * shape.half_m.y(), kNoGoHeight_m}, kNoGo));
  }
  for (const DoorPlan& door : plan.doors) {
    const double w = door.opening_width_m / 2, h = door.opening_height_m;
    Json frame = LinesJson({{0, w, 0}, {0, w, h}, {0, -w, h}, {0, -w, 0}}, kWood, false, 0.03);
    frame["pose"] = PoseJson(door.map_from_door());
    entity["lines"].push_back(std::move(frame));
    entity["texts"].push_back(LabelJson({door.x_m, door.y_m, h + 0.15}, door.name, kWood));
  }
  return {kPlan, now, UpdateJson({std::move(entity)})};
}

std::vector<Scene::Message> Scene::Pose(const Json& message, Time valid) const {
  const auto pose = PoseOf(message);
  if (!pose) return {};
  const Json at = PoseJson(*pose);
  Json transform = {{"timestamp", StampJson(valid)},
                    {"parent_frame_id", "map"},
                    {"child_frame_id", "base"},
                    {"translation", at["position"]},
                    {"rotation", at["orientation"]}};
  Json body = EntityJson("body", {"base", true}, valid);
  body["cubes"].push_back(BoxJson({}, {body_.length_m, body_.width_m, 0.5}, {0.04, 0.36, 0.72, 0.4}));
  const double front = body_.length_m / 2;
  body["lines"].push_back(LinesJson({{0, 0.2, 0.51}, {front, 0, 0.51}, {0, -0.2, 0.51}}, kRobotBlue, false));
  body["lines"].push_back(
      LinesJson({{kDrawnHead.x_m, kDrawnHead.y_m, 0.5}, {kDrawnHead.x_m, kDrawnHead.y_m, kDrawnHead.z_m}},
                kRobotBlue, false));
  std::vector<Json> entities{std::move(body)};
  if (const auto s = NumbersOf<3>(message, {"sigma_x_m", "sigma_y_m", "rho_x_y"})) {
    Json doubt = EntityJson("uncertainty", {}, valid);
    doubt["lines"].push_back(LinesJson(Ellipse(*pose, (*s)[0], (*s)[1], (*s)[2]), kRobotBlue, false));
    entities.push_back(std::move(doubt));
  }
  return {{kTransform, valid, std::move(transform)}, {kRobot, valid, UpdateJson(std::move(entities))}};
}

std::vector<Scene::Message> Scene::Path(const Json& message, Time valid) const {
  if (!message.is_object() || !message.contains("path_id")) return {};
  Points points;
  for (const Json& point : ListOf(message, "points"))
    if (const auto pose = PoseOf(point)) points.emplace_back(pose->x, pose->y, 0.02);
  Json entity = EntityJson("path", {}, valid);
  if (!points.empty()) entity["lines"].push_back(LinesJson(points, kPathViolet, false, 0.03));
  return {{kPath, valid, UpdateJson({std::move(entity)})}};
}

std::vector<Scene::Message> Scene::Sonars(const Json& message, Time valid) const {
  const Json& ranges = ListOf(message, "range_m");
  if (ranges.size() != kSonars) return {};
  Points points;
  for (int i = 0; i < kSonars; ++i) {
    const Json& range = ranges[std::size_t(i)];
    if (!range.is_number() || range.get<double>() < 0) continue;
    const Pose2 echo = BaseFromSonar(i, {body_.length_m, body_.width_m}) * Pose2{range.get<double>(), 0, 0};
    points.emplace_back(echo.x, echo.y, kSonarHeight_m);
  }
  Json fields = Json::array();
  for (const char* axis : {"x", "y", "z"})
    fields.push_back({{"name", axis}, {"offset", fields.size() * sizeof(float)}, {"type", kFloat32}});
  return {{kEchoes,
           valid,
           {{"timestamp", StampJson(valid)},
            {"frame_id", "base"},
            {"pose", PoseJson({})},
            {"point_stride", 3 * sizeof(float)},
            {"fields", std::move(fields)},
            {"data", PackedPoints(points)}}}};
}

std::vector<Scene::Message> Scene::Model(const Json& message, Time valid) {
  const auto id = SmallOf(message, "landmark_id");
  const auto pose = PoseOf(message);
  if (!id || !pose || (models_.size() >= kMostModels && !models_.contains(*id))) return {};
  models_[*id] = message;
  return {{kLandmarks, valid,
           UpdateJson(
               {SkeletonEntity("expected " + std::to_string(*id), {}, *pose, message, kExpected, valid)})}};
}

/// The landmark stands where it was found: relative to the base at the moment of the exposure.
std::vector<Scene::Message> Scene::Fix(const Json& message, Time valid) const {
  const auto id = SmallOf(message, "landmark_id"), verdict = SmallOf(message, "verdict");
  const auto pose = PoseOf(message);
  const auto model = id ? models_.find(*id) : models_.end();
  if (!pose || !verdict || *verdict != kFoundVerdict || model == models_.end()) return {};
  return {{kLandmarks, valid,
           UpdateJson({SkeletonEntity("found " + std::to_string(*id), {"base", false}, *pose, model->second,
                                      kFound, valid)})}};
}

std::vector<Scene::Message> Scene::View(const Json& message, Time valid) const {
  constexpr std::array kKinds{kExpected, kFound, kDanger};
  std::array<Json, 3> ends{Json::array(), Json::array(), Json::array()};
  if (!message.is_object() || !message.contains("edges")) return {};
  for (const Json& edge : ListOf(message, "edges")) {
    const auto v = NumbersOf<5>(edge, {"kind", "u1_px", "v1_px", "u2_px", "v2_px"});
    if (!v || (*v)[0] < 0 || (*v)[0] >= double(ends.size())) continue;
    Json& list = ends[std::size_t((*v)[0])];
    list.push_back({{"x", (*v)[1]}, {"y", (*v)[2]}});
    list.push_back({{"x", (*v)[3]}, {"y", (*v)[4]}});
  }
  Json points = Json::array();
  for (std::size_t i = 0; i < ends.size(); ++i)
    points.push_back({{"timestamp", StampJson(valid)},
                      {"type", kPointList},
                      {"points", std::move(ends[i])},
                      {"outline_color", ColourJson(kKinds[i])},
                      {"outline_colors", Json::array()},
                      {"fill_color", ColourJson({0, 0, 0, 0})},
                      {"thickness", 2}});
  return {
      {kView, valid, {{"circles", Json::array()}, {"points", std::move(points)}, {"texts", Json::array()}}}};
}

std::vector<Scene::Message> Scene::Obstacles(const Json& message, Time valid) const {
  if (!message.is_object() || !message.contains("segments")) return {};
  Json entity = EntityJson("obstacles", {"base", false}, valid);
  for (const Json& segment : ListOf(message, "segments"))
    if (const auto v = NumbersOf<5>(segment, {"x1_m", "y1_m", "x2_m", "y2_m", "height_m"}))
      entity["lines"].push_back(
          LinesJson({{(*v)[0], (*v)[1], (*v)[4]}, {(*v)[2], (*v)[3], (*v)[4]}}, kDanger, false, 0.03));
  return {{kObstacles, valid, UpdateJson({std::move(entity)})}};
}

}  // namespace priamos::console
