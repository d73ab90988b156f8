#include "head/see/see_doors.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace priamos::head {
namespace {

constexpr drawing::Colour kMagenta{0xff40ff};
constexpr drawing::Layer kAnyEdge{"edge", "edge", {.line = drawing::Colour{0x969696}, .width = 0.8}};
constexpr drawing::Layer kDoor{"door", "door: posts and lintel", {.line = kMagenta, .width = 2}};

/// Left foot, left corner, right corner, right foot.
std::array<Eigen::Vector2d, 4> Outline(const CameraModel& camera, const DetectedDoor& door) {
  std::array<Eigen::Vector2d, 4> outline;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d at = door.base_from_door * Eigen::Vector2d(0, (i < 2 ? 0.5 : -0.5) * door.width_m);
    const double z = i == 1 || i == 2 ? door.height_m : 0;
    outline[i] = camera.Distort(camera.Project({at.x(), at.y(), z}));
  }
  return outline;
}

}  // namespace

CameraStand StandFrom(const std::vector<double>& stand) {
  const auto within = [](double v, double least, double most) { return v >= least && v <= most; };
  if (stand.empty() || stand.size() > 3 || !within(stand[0], 0.1, 10) ||
      !std::all_of(stand.begin() + 1, stand.end(), [&](double angle) { return within(angle, -90, 90); }))
    throw std::runtime_error(
        fmt::format("--stand: expected the height of the left camera above the floor, 0.1 to 10 m, and its "
                    "tilt and roll, -90 to 90 degrees, got {}",
                    fmt::join(stand, " ")));
  return {stand[0], stand.size() > 1 ? Radians(stand[1]) : 0, stand.size() > 2 ? Radians(stand[2]) : 0};
}

SeePage DrawDoors(std::span<const cv::Mat> greys, std::span<const CameraView> views,
                  std::span<const DetectedDoor> doors) {
  SeePage page(greys);
  for (std::size_t c = 0; c < greys.size(); ++c) {
    for (const EdgeSegment& s : views[c].edges->segments) page.Line(kAnyEdge, c, s.begin, s.end);
    for (std::size_t i = 0; i < doors.size(); ++i) {
      const auto outline = Outline(*views[c].camera, doors[i]);
      for (std::size_t k = 0; k < 3; ++k) page.Line(kDoor, c, outline[k], outline[k + 1]);
      page.Label(c, outline[1], fmt::format("{}", i + 1), kMagenta);
    }
  }
  page.Finish();
  return page;
}

nlohmann::ordered_json DoorsToJson(std::span<const DetectedDoor> doors) {
  auto list = nlohmann::ordered_json::array();
  for (const DetectedDoor& door : doors) {
    const Pose2& at = door.base_from_door;
    list.push_back({{"middle_m", {at.x, at.y}},
                    {"yaw_deg", Degrees(at.yaw)},
                    {"width_m", door.width_m},
                    {"height_m", door.height_m},
                    {"on_floor", door.on_floor},
                    {"log_odds", door.log_odds},
                    {"sigma_m",
                     {std::sqrt(std::max(0.0, door.covariance(0, 0))),
                      std::sqrt(std::max(0.0, door.covariance(1, 1)))}}});
  }
  return list;
}

}  // namespace priamos::head
