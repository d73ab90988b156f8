#include "head/see/see_image_doors.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace priamos::head {
namespace {

constexpr drawing::Colour kPostColour{0xff40ff};
constexpr drawing::Layer kThinEdge{"edge", "edge", {.line = drawing::Colour{0x969696}, .width = 0.8}};
constexpr drawing::Layer kImageDoor{"door", "door: posts and lintel", {.line = kPostColour, .width = 2}};
constexpr drawing::Layer kHorizon{"horizon", "horizon", {.line = drawing::Colour{0x40c0ff}, .width = 1}};

/// Row of the horizon in a column of the image; nullopt where it is not in it.
std::optional<Eigen::Vector2d> HorizonAt(const CameraModel& camera, double u, const cv::Mat& grey) {
  // Level directions are imaged on the line cross(image of x, image of y).
  const Eigen::Vector3d line = camera.image_from_base.col(0).cross(camera.image_from_base.col(1));
  const Eigen::Vector2d at = camera.Distort({u, -(line.x() * u + line.z()) / line.y()});
  if (!at.allFinite() || at.y() < 0 || at.y() > grey.rows - 1) return std::nullopt;
  return at;
}

/// Left foot, left corner, right corner, right foot [px of the image].
std::array<Eigen::Vector2d, 4> Posts(const CameraModel& camera, const ImageDoor& door) {
  return {camera.Distort(door.feet[0]), camera.Distort(door.corners[0]), camera.Distort(door.corners[1]),
          camera.Distort(door.feet[1])};
}

nlohmann::ordered_json Pixels(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return {{a.x(), a.y()}, {b.x(), b.y()}};
}

double Sigma_deg(const SeenStand& stand, int axis) {
  return Degrees(std::sqrt(std::max(0.0, stand.covariance(axis, axis))));
}

}  // namespace

SeePage DrawImageDoors(const cv::Mat& grey, const SeenDoors& seen) {
  SeePage page(std::span(&grey, 1));
  for (const EdgeSegment& s : seen.edges[0].segments) page.Line(kThinEdge, 0, s.begin, s.end);
  const CameraModel& camera = seen.cameras[0];
  if (seen.why_not.empty()) {
    const auto left = HorizonAt(camera, 0, grey), right = HorizonAt(camera, grey.cols - 1, grey);
    if (left && right) page.Line(kHorizon, 0, *left, *right);
  }
  for (std::size_t i = 0; i < seen.in_image.size(); ++i) {
    const auto posts = Posts(camera, seen.in_image[i]);
    for (std::size_t k = 0; k < 3; ++k) page.Line(kImageDoor, 0, posts[k], posts[k + 1]);
    page.Label(0, posts[1], fmt::format("{}", i + 1), kPostColour);
  }
  page.Finish();
  return page;
}

nlohmann::ordered_json ImageDoorsToJson(const SeenDoors& seen) {
  auto list = nlohmann::ordered_json::array();
  for (const ImageDoor& door : seen.in_image) {
    const auto posts = Posts(seen.cameras[0], door);
    const Pose2& at = door.base_from_door;
    list.push_back({{"corners_px", Pixels(posts[1], posts[2])},
                    {"feet_px", Pixels(posts[0], posts[3])},
                    {"middle_m", {at.x, at.y}},
                    {"range_m", door.range_m},
                    {"sigma_range_m", door.range_sigma_m},
                    {"yaw_deg", Degrees(at.yaw)},
                    {"sigma_yaw_deg", Degrees(door.yaw_sigma_rad)},
                    {"width_m", door.width_m},
                    {"height_m", door.height_m},
                    {"width_over_height", door.shape},
                    {"sigma_width_over_height", door.shape_sigma},
                    {"on_floor", door.on_floor},
                    {"log_odds", door.log_odds}});
  }
  return list;
}

nlohmann::ordered_json StandToJson(const SeenDoors& seen) {
  if (!seen.why_not.empty()) return {{"unknown", seen.why_not}};
  const CameraStand& stand = seen.stand.stand;
  nlohmann::ordered_json json{
      {"height_m", stand.height_m},          {"sigma_height_m", seen.stand.height_sigma_m},
      {"tilt_deg", Degrees(stand.tilt_rad)}, {"sigma_tilt_deg", Sigma_deg(seen.stand, 0)},
      {"roll_deg", Degrees(stand.roll_rad)}, {"sigma_roll_deg", Sigma_deg(seen.stand, 1)}};
  if (!(stand.height_m > 0)) return json;
  json["height_m"] = stand.height_m;
  json["sigma_height_m"] = seen.stand.height_sigma_m;
  if (!seen.stand.height_from.empty()) json["height_from"] = seen.stand.height_from;
  return json;
}

std::string StandText(const SeenDoors& seen) {
  if (!seen.why_not.empty())
    return fmt::format("how the camera stands: not known, {}; no doors were looked for\n", seen.why_not);
  const CameraStand& stand = seen.stand.stand;
  std::string text;
  if (seen.stand.is_estimated)
    text = fmt::format(
        "how the camera stands: tilt {:.2f} deg (sigma {:.2f}), roll {:.2f} deg (sigma {:.2f})\n",
        Degrees(stand.tilt_rad), Sigma_deg(seen.stand, 0), Degrees(stand.roll_rad), Sigma_deg(seen.stand, 1));
  if (seen.stand.height_sigma_m > 0)
    text += fmt::format("  {:.2f} m above the floor (sigma {:.2f}), by {}\n", stand.height_m,
                        seen.stand.height_sigma_m, seen.stand.height_from);
  return text;
}

std::string ImageDoorsText(const SeenDoors& seen, const std::string& drawing) {
  std::string text = fmt::format("doors: {}, drawn in {}\n", seen.in_image.size(), drawing);
  int number = 0;
  for (const ImageDoor& door : seen.in_image)
    text += fmt::format(
        "  door {}: {:.1f} m away (sigma {:.1f}), turned by {:.1f} deg (sigma {:.1f}); width over height "
        "{:.2f} (sigma {:.2f}), log odds {:.1f}\n",
        ++number, door.range_m, door.range_sigma_m, Degrees(door.base_from_door.yaw),
        Degrees(door.yaw_sigma_rad), door.shape, door.shape_sigma, door.log_odds);
  return text;
}

}  // namespace priamos::head
