#include "head/files/laser_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "common/config.hpp"
#include "common/geometry.hpp"
#include "common/vector_key.hpp"
#include "head/files/calibration_file.hpp"
#include "head/files/image_file.hpp"

namespace priamos::head {
namespace {

using nlohmann::ordered_json;

constexpr int kMostLasers = 4;

HeadSetting SettingOf(const LaserPicture& picture) {
  HeadSetting setting;
  setting.pan_rad = Radians(picture.pan_deg);
  setting.tilt_rad = Radians(picture.tilt_deg);
  return setting;
}

/// The lines of a picture, that of the nearest laser first: it is the lowest. Empty where it has none.
std::vector<std::vector<StripePoint>> LinesOf(const LaserPicture& picture, int lasers,
                                              const GreyImage& image) {
  StripeFinder finder;
  std::vector<std::vector<StripePoint>> lines(static_cast<std::size_t>(lasers));
  if (picture.line > 0) {
    lines[static_cast<std::size_t>(picture.line) - 1] = finder.Find(image);
    return lines;
  }
  lines = finder.FindInOrder(image, lasers);
  std::ranges::reverse(lines);
  return lines;
}

/// What one picture says of each laser.
struct PictureViews {
  std::string image;
  std::vector<StripeView> views;
};

PictureViews ViewsOf(const LaserPicture& picture, int lasers, const std::string& path, const HeadModel& head,
                     std::string& notes) {
  const auto camera = head.CameraAt(SettingOf(picture), kThird);
  if (!camera) throw ConfigError("third camera: " + camera.reason() + "; calibrate it first");
  PictureViews result{picture.image, {}};
  bool any = false;
  for (auto& points : LinesOf(picture, lasers, ReadImage(path, notes))) {
    any = any || !points.empty();
    result.views.push_back(
        {*camera, {picture.normal.normalized(), picture.board_m}, std::move(points), picture.error_m});
  }
  if (!any)
    throw ConfigError(
        lasers == 1 || picture.line > 0
            ? fmt::format("{}: expected a line of laser light, got none", path)
            : fmt::format("{}: expected {} lines of laser light, one above the other, got fewer; "
                          "where it shows one of them, say which: line = 1 is the lowest",
                          path, lasers));
  return result;
}

ordered_json VectorAsJson(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

/// One laser, from all pictures that show its line.
struct CalibratedLaser {
  LaserCalibration result;
  std::vector<std::string> images;  ///< of the views
};

CalibratedLaser CalibrateOne(const std::vector<PictureViews>& pictures, std::size_t number,
                             const std::string& path) {
  CalibratedLaser laser;
  std::vector<StripeView> views;
  for (const PictureViews& picture : pictures) {
    if (picture.views[number].points.empty()) continue;
    laser.images.push_back(picture.image);
    views.push_back(picture.views[number]);
  }
  const auto result = CalibrateLaserPlane(views);
  if (!result) throw ConfigError(fmt::format("{}: line {}: {}", path, number + 1, result.reason()));
  laser.result = *result;
  if (const LaserPlane& plane = laser.result.plane; !plane.MeetsFloorAhead())
    throw ConfigError(fmt::format(
        "{}: line {}: its light would meet the floor {:.2f} m ahead of the base centre, expected {} to {} m; "
        "are `board_m`, `normal` and `line` of the views right?",
        path, number + 1, plane.FloorAhead_m(), kNearestLight_m, kFarthestLight_m));
  return laser;
}

ordered_json AsJson(const CalibratedLaser& calibrated, const HeadModel& head) {
  const LaserCalibration& result = calibrated.result;
  ordered_json views = ordered_json::array();
  for (std::size_t k = 0; k < calibrated.images.size(); ++k)
    views.push_back({{"image", calibrated.images[k]}, {"rms_px", result.view_rms_px[k]}});
  const LaserPlane& laser = result.plane;
  const LensTable& lens = head.lenses[kThird];
  const auto ahead = laser.InCamera(head.geometry.BaseFromCamera({}, kThird, lens.nodes().front().pupil_m));
  return {{"points", result.points},
          {"outliers", result.outliers},
          {"rms_px", result.rms_px},
          {"views", views},
          {"floor_m", laser.FloorAhead_m()},
          {"base", {{"normal", VectorAsJson(laser.normal)}, {"offset_m", laser.offset_m}}},
          {"third_camera_ahead", {{"normal", VectorAsJson(ahead.normal())}, {"offset_m", ahead.offset()}}},
          {"pivot_m", VectorAsJson(laser.pivot_m)},
          {"sigma_turn_deg", Degrees(laser.sigma_turn_rad)},
          {"sigma_shift_m", laser.sigma_shift_m}};
}

}  // namespace

void LaserPicture::Describe(Archive& a) {
  a.Text("image", image, "picture of the third camera, beside this file");
  a.Number("pan_deg", pan_deg, {"deg", -180, 180, "pan of the head at the exposure"});
  a.Number("tilt_deg", tilt_deg, {"deg", -90, 90, "tilt of the head at the exposure, positive looks down"});
  Vector(a, "board_m", board_m, {"m", -20, 20, "a point of the board in the base frame"});
  Vector(a, "normal", normal, {"-", -1e3, 1e3, "across the board, of any length"});
  a.Number("error_m", error_m, {"m", 0, 0.1, "how exactly the board stands there, across itself: 1 sigma"});
  a.Integer("line", line,
            {"-", 0, kMostLasers, "the only line that it shows, from the nearest on the floor; 0: all"});
  if (normal.norm() < 1e-6) a.Refuse("normal", "a direction that is not zero");
}

void LaserPictures::Describe(Archive& a) {
  a.Integer("lasers", lasers, {"-", 1, kMostLasers, "how many line lasers there are"});
  a.List("view", views, "pictures of their lines on boards or floors whose places are known");
  if (views.empty()) a.Refuse("view", "at least one picture");
  for (const LaserPicture& view : views) {
    if (view.line > lasers) a.Refuse("view", fmt::format("`line` up to {}, the number of lasers", lasers));
  }
}

OfflineReport CalibrateLaserFromFiles(const std::string& pictures_path, const std::string& table,
                                      const std::string& output) {
  const ConfigSource source{pictures_path, {}};
  const auto pictures = LoadConfig<LaserPictures>(source);
  HeadModel head = LoadHeadModel(table);
  OfflineReport report;
  std::vector<PictureViews> views;
  for (const LaserPicture& picture : pictures.views)
    views.push_back(
        ViewsOf(picture, pictures.lasers, source.Folder() + "/" + picture.image, head, report.notes));
  ordered_json lasers = ordered_json::array();
  head.lasers.clear();
  for (int k = 0; k < pictures.lasers; ++k) {
    const CalibratedLaser laser = CalibrateOne(views, static_cast<std::size_t>(k), pictures_path);
    head.lasers.push_back(laser.result.plane);
    lasers.push_back(AsJson(laser, head));
  }
  SaveHeadModel(output.empty() ? table : output, head);
  report.json = ordered_json{{"lasers", lasers}}.dump(2);
  return report;
}

}  // namespace priamos::head
