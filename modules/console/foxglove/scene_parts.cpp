#include "console/foxglove/scene_parts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace priamos::console {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kLineStrip = 0, kLineList = 2;

Json VectorJson(const Eigen::Vector3d& v) {
  return {{"x", v.x()}, {"y", v.y()}, {"z", v.z()}};
}

}  // namespace

Json StampJson(Time time) {
  const std::int64_t us = std::max<std::int64_t>(ToUtime(time), 0);
  return {{"sec", us / 1'000'000}, {"nsec", us % 1'000'000 * 1000}};
}

Json PoseJson(const Pose2& pose, double z_m) {
  return {{"position", VectorJson({pose.x, pose.y, z_m})},
          {"orientation",
           {{"x", 0.0}, {"y", 0.0}, {"z", std::sin(pose.yaw / 2)}, {"w", std::cos(pose.yaw / 2)}}}};
}

Json ColourJson(const Colour& colour) {
  return {{"r", colour.r}, {"g", colour.g}, {"b", colour.b}, {"a", colour.a}};
}

Json LinesJson(const Points& points, const Colour& colour, bool pairs, double thickness_m) {
  Json list = Json::array();
  for (const Eigen::Vector3d& point : points) list.push_back(VectorJson(point));
  return {{"type", pairs ? kLineList : kLineStrip},
          {"pose", PoseJson({})},
          {"thickness", thickness_m},
          {"scale_invariant", false},
          {"points", std::move(list)},
          {"color", ColourJson(colour)},
          {"colors", Json::array()},
          {"indices", Json::array()}};
}

Json BoxJson(const Pose2& centre, const Eigen::Vector3d& size_m, const Colour& colour, double z_m) {
  return {{"pose", PoseJson(centre, z_m + size_m.z() / 2)},
          {"size", VectorJson(size_m)},
          {"color", ColourJson(colour)}};
}

Json LabelJson(const Eigen::Vector3d& at, const std::string& text, const Colour& colour) {
  return {{"pose", PoseJson({at.x(), at.y(), 0}, at.z())},
          {"billboard", true},
          {"font_size", 0.15},
          {"scale_invariant", false},
          {"color", ColourJson(colour)},
          {"text", text}};
}

Json EntityJson(const std::string& id, const EntityFrame& frame, Time time) {
  Json entity = {{"timestamp", StampJson(time)},
                 {"frame_id", frame.name},
                 {"id", id},
                 {"lifetime", {{"sec", 0}, {"nsec", 0}}},
                 {"frame_locked", frame.follows}};
  for (const char* kind :
       {"metadata", "arrows", "cubes", "spheres", "cylinders", "lines", "triangles", "texts", "models"})
    entity[kind] = Json::array();
  return entity;
}

Json UpdateJson(std::vector<Json> entities) {
  return {{"deletions", Json::array()}, {"entities", std::move(entities)}};
}

}  // namespace priamos::console
