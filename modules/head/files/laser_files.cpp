#include "head/files/laser_files.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "common/config.hpp"
#include "common/geometry.hpp"
#include "common/vector_key.hpp"
#include "head/files/calibration_file.hpp"
#include "head/files/image_file.hpp"

namespace priamos::head {
namespace {

using nlohmann::ordered_json;

HeadSetting SettingOf(const LaserPicture& picture) {
  HeadSetting setting;
  setting.pan_rad = Radians(picture.pan_deg);
  setting.tilt_rad = Radians(picture.tilt_deg);
  return setting;
}

StripeView ViewOf(const LaserPicture& picture, const std::string& path, const HeadModel& head,
                  std::string& notes) {
  const auto camera = head.CameraAt(SettingOf(picture), kThird);
  if (!camera) throw ConfigError("third camera: " + camera.reason() + "; calibrate it first");
  StripeView view{*camera,
                  {picture.normal.normalized(), picture.board_m},
                  StripeFinder().Find(ReadImage(path, notes)),
                  picture.error_m};
  if (view.points.empty())
    throw ConfigError(fmt::format("{}: expected a line of laser light, got none", path));
  return view;
}

ordered_json VectorAsJson(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

std::string Describe(const LaserCalibration& result, const LaserPictures& pictures, const HeadModel& head) {
  ordered_json views = ordered_json::array();
  for (std::size_t k = 0; k < pictures.views.size(); ++k)
    views.push_back({{"image", pictures.views[k].image}, {"rms_px", result.view_rms_px[k]}});
  const LaserPlane& laser = result.plane;
  const LensTable& lens = head.lenses[kThird];
  const auto ahead = laser.InCamera(head.geometry.BaseFromCamera({}, kThird, lens.nodes().front().pupil_m));
  return ordered_json{
      {"points", result.points},
      {"outliers", result.outliers},
      {"rms_px", result.rms_px},
      {"views", views},
      {"base", {{"normal", VectorAsJson(laser.normal)}, {"offset_m", laser.offset_m}}},
      {"third_camera_ahead", {{"normal", VectorAsJson(ahead.normal())}, {"offset_m", ahead.offset()}}},
      {"pivot_m", VectorAsJson(laser.pivot_m)},
      {"sigma_turn_deg", Degrees(laser.sigma_turn_rad)},
      {"sigma_shift_m", laser.sigma_shift_m}}
      .dump(2);
}

}  // namespace

void LaserPicture::Describe(Archive& a) {
  a.Text("image", image, "picture of the third camera, beside this file");
  a.Number("pan_deg", pan_deg, {"deg", -180, 180, "pan of the head at the exposure"});
  a.Number("tilt_deg", tilt_deg, {"deg", -90, 90, "tilt of the head at the exposure, positive looks down"});
  Vector(a, "board_m", board_m, {"m", -20, 20, "a point of the board in the base frame"});
  Vector(a, "normal", normal, {"-", -1e3, 1e3, "across the board, of any length"});
  a.Number("error_m", error_m, {"m", 0, 0.1, "how exactly the board stands there, across itself: 1 sigma"});
  if (normal.norm() < 1e-6) a.Refuse("normal", "a direction that is not zero");
}

void LaserPictures::Describe(Archive& a) {
  a.List("view", views, "pictures of the line on boards or floors whose places are known");
  if (views.empty()) a.Refuse("view", "at least one picture");
}

OfflineReport CalibrateLaserFromFiles(const std::string& pictures_path, const std::string& table,
                                      const std::string& output) {
  const ConfigSource source{pictures_path, {}};
  const auto pictures = LoadConfig<LaserPictures>(source);
  HeadModel head = LoadHeadModel(table);
  OfflineReport report;
  std::vector<StripeView> views;
  for (const LaserPicture& picture : pictures.views)
    views.push_back(ViewOf(picture, source.Folder() + "/" + picture.image, head, report.notes));
  const auto result = CalibrateLaserPlane(views);
  if (!result) throw ConfigError(fmt::format("{}: {}", pictures_path, result.reason()));
  head.laser = result->plane;
  SaveHeadModel(output.empty() ? table : output, head);
  report.json = Describe(*result, pictures, head);
  return report;
}

}  // namespace priamos::head
