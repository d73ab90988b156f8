#include "head/files/offline_calibration.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "common/config.hpp"
#include "common/geometry.hpp"
#include "head/core/calibration/discs/disc_detection.hpp"
#include "head/core/calibration/resection/camera_parameters.hpp"
#include "head/core/calibration/resection/point_list.hpp"
#include "head/core/calibration/targets/calibration_quality.hpp"
#include "head/core/calibration/targets/same_view.hpp"
#include "head/files/image_file.hpp"
#include "head/files/model_text.hpp"

namespace priamos::head {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kMostPoints_MB = 16;
constexpr double kWorstMeasured_px = 5;  // points measured by hand may be off by pixels

/// What is known of a camera that nobody has described: next to nothing.
LensKnowledge UnknownLens(int width_px, int height_px) {
  LensKnowledge lens;
  lens.aspect_sigma = 0.05;
  lens.skew_sigma_rad = 0.005;
  lens.k1_sigma = 0.5;
  lens.k2_sigma = 0.5;
  lens.worst_error_px = kWorstMeasured_px;
  const bool known = width_px > 0 && height_px > 0;
  lens.centre_px =
      known ? Eigen::Vector2d((width_px - 1) / 2.0, (height_px - 1) / 2.0) : Eigen::Vector2d(0, 0);
  lens.centre_sigma_px = known ? 0.05 * std::hypot(width_px, height_px) : 1e4;
  return lens;
}

std::string PointsText(const std::string& path) {
  auto text = ReadText(path, "a list of points", kMostPoints_MB);
  if (!text) throw ConfigError(text.reason());
  return std::move(*text);
}

template <class T>
T Must(const std::string& path, Outcome<T> outcome) {
  if (!outcome) throw ConfigError(fmt::format("{}: {}", path, outcome.reason()));
  return std::move(*outcome);
}

std::vector<DiscObservation> ToObservations(const std::vector<PointPair>& pairs, double sigma_px) {
  std::vector<DiscObservation> observations;
  observations.reserve(pairs.size());
  // Points: discs without extent, which have no bias.
  for (const PointPair& p : pairs)
    observations.push_back({{p.point_m, Eigen::Vector3d::UnitX(), 0}, p.image_px, sigma_px});
  return observations;
}

/// Noise of the image points [px], which the file does not give: estimated from the residuals of the DLT
/// matrix.
double NoiseOf(const std::vector<PointPair>& pairs, const Eigen::Matrix<double, 3, 4>& dlt) {
  return std::max(0.02, 0.8 * MeanImageError(dlt, pairs));
}

ordered_json RowsAsJson(const Eigen::MatrixXd& m) {
  ordered_json rows = ordered_json::array();
  for (int r = 0; r < m.rows(); ++r) rows.push_back(std::vector<double>(m.cols()));
  for (int r = 0; r < m.rows(); ++r)
    for (int c = 0; c < m.cols(); ++c) rows[r][c] = m(r, c);
  return rows;
}

ordered_json LensJson(const CameraModel& model) {
  const auto p = ExtractParameters(model.image_from_base);
  if (!p) return p.reason();
  const Eigen::Vector3d angles = p->OmegaPhiKappa();
  return {{"K", RowsAsJson(p->Intrinsics())},
          {"k1", model.k1},
          {"k2", model.k2},
          {"centre_m", {p->centre_m.x(), p->centre_m.y(), p->centre_m.z()}},
          {"omega_phi_kappa_deg", {Degrees(angles.x()), Degrees(angles.y()), Degrees(angles.z())}},
          {"axes_angle_deg", Degrees(p->axes_angle_rad)}};
}

/// Size of the images of a camera [px], for who reads the file; 0: not known.
struct SizeOfImages {
  int width = 0, height = 0;

  void AddTo(ordered_json& json) const {
    if (width > 0) json.update({{"image_width", width}, {"image_height", height}});
  }
};

ordered_json CameraJson(const std::string& name, const CameraCalibration& camera, const LensKnowledge& lens,
                        const SizeOfImages& size) {
  const PredictionErrors errors = PredictHeldOut(camera.observations, lens);
  ordered_json json{{"name", name},
                    {"points", camera.discs},
                    {"F_px", camera.mean_error_px},
                    {"F_dlt_px", camera.dlt_error_px},
                    {"leave_one_out_F_px", errors.leave_one_out_px},
                    {"held_out_F_px", errors.held_out_px},
                    {"recalibrations_failed", errors.failed}};
  size.AddTo(json);
  json.update(LensJson(camera.model));
  json["image_from_points"] = RowsAsJson(camera.model.image_from_base);
  return json;
}

ordered_json StereoJson(const std::vector<CameraCalibration>& cameras) {
  const ReconstructionErrors e = Reconstruct(CommonPoints(cameras));
  if (e.points == 0) return nullptr;
  return {{"points", e.points}, {"mean_m", e.mean_m}, {"rms_m", e.rms_m}, {"max_m", e.max_m}};
}

std::string Several(const std::vector<std::string>& names, const std::vector<CameraCalibration>& cameras,
                    const std::vector<LensKnowledge>& lenses, const std::vector<SizeOfImages>& sizes) {
  ordered_json list = ordered_json::array();
  for (std::size_t i = 0; i < cameras.size(); ++i)
    list.push_back(CameraJson(names[i], cameras[i], lenses[i], sizes[i]));
  return ordered_json{{"cameras", list}, {"stereo", StereoJson(cameras)}}.dump(2);
}

std::string FromPoints(const OfflineCalibration& input) {
  std::vector<CameraCalibration> cameras;
  const LensKnowledge lens = UnknownLens(input.width_px, input.height_px);
  for (const std::string& path : input.points) {
    const auto parsed = ParsePointList(PointsText(path));
    if (!parsed) throw ConfigError(fmt::format("{}:{}", path, parsed.reason()));
    const auto dlt = Must(path, SolveDlt(*parsed));
    cameras.push_back(Must(path, CalibrateFromDiscs(ToObservations(*parsed, NoiseOf(*parsed, dlt)), lens)));
  }
  return Several(input.points, cameras, std::vector<LensKnowledge>(cameras.size(), lens),
                 std::vector<SizeOfImages>(cameras.size(), {input.width_px, input.height_px}));
}

/// One photograph per camera.
std::string FromObject(const OfflineCalibration& input, std::string& notes) {
  const auto object = LoadConfig<ReferenceObject>(input.object);
  std::vector<CameraCalibration> cameras;
  std::vector<LensKnowledge> lenses;
  std::vector<SizeOfImages> sizes;
  for (const std::string& path : input.photographs) {
    const GreyImage image = ReadImage(path, notes);
    sizes.push_back({image.width, image.height});
    lenses.push_back({});
    lenses.back().centre_px = {(image.width - 1) / 2.0, (image.height - 1) / 2.0};
    LabellerOptions options;
    options.image_centre_px = lenses.back().centre_px;
    cameras.push_back(Must(path, CalibrateCamera(image, object, DiscLabeller(object, options),
                                                 Eigen::Isometry3d::Identity(), lenses.back())));
  }
  return Several(input.photographs, cameras, lenses, sizes);
}

/// Mean F of the photographs when the lens comes from all others and only the pose from itself; -1: not to be
/// had.
double LeaveOneViewOut(const std::vector<std::vector<DiscObservation>>& views, int width, int height,
                       const LensKnowledge& lens) {
  double sum = 0;
  std::size_t n = 0;
  for (std::size_t k = 0; k < views.size(); ++k) {
    auto others = views;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    const auto calibrated = CalibrateFromPlanes(others, width, height, lens);
    if (!calibrated) continue;
    const auto error = ErrorWithLens(views[k], calibrated->front().model);
    if (!error) continue;
    sum += *error;
    ++n;
  }
  return n > 0 ? sum / static_cast<double>(n) : -1;
}

constexpr std::size_t kFewestViews = 3;  ///< as CalibrateFromPlanes needs them

/// Photographs that show different views of a target; one that shows a view again counts once.
struct DifferentViews {
  std::vector<std::string> names;
  std::vector<std::vector<DiscObservation>> points;

  void Add(const std::string& name, std::vector<DiscObservation> view, std::string& notes) {
    for (std::size_t i = 0; i < points.size(); ++i)
      if (ShowSameView(points[i], view)) {
        notes += fmt::format("{} shows the same view as {}: both count as one\n", name, names[i]);
        return;
      }
    names.push_back(name);
    points.push_back(std::move(view));
  }
};

/// All photographs by one camera.
std::string FromFlatTarget(const OfflineCalibration& input, std::string& notes) {
  DifferentViews views;
  int width = 0, height = 0;
  for (const std::string& path : input.photographs) {
    const GreyImage image = ReadImage(path, notes);
    if (!views.points.empty() && (image.width != width || image.height != height))
      throw ConfigError(fmt::format("{}: expected {} by {} pixels like the others, got {} by {}", path, width,
                                    height, image.width, image.height));
    width = image.width;
    height = image.height;
    views.Add(
        path,
        Must(path, input.chessboard ? FindCorners(image, *input.chessboard) : FindDots(image, input.target)),
        notes);
  }
  if (const auto n = views.names.size(); n < kFewestViews && n < input.photographs.size())
    throw ConfigError(fmt::format(
        "{}: expected photographs of at least {} different views of the target, got {} photographs of {}",
        fmt::join(input.photographs, ", "), kFewestViews, input.photographs.size(), n));
  const LensKnowledge lens = UnknownLens(width, height);
  const auto cameras =
      Must(input.photographs.front(), CalibrateFromPlanes(views.points, width, height, lens));
  double sum = 0;
  ordered_json list = ordered_json::array();
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    sum += cameras[i].mean_error_px / static_cast<double>(cameras.size());
    list.push_back(
        {{"name", views.names[i]}, {"points", cameras[i].discs}, {"F_px", cameras[i].mean_error_px}});
  }
  ordered_json json{{"photographs", list},
                    {"F_px", sum},
                    {"leave_one_photograph_out_F_px", LeaveOneViewOut(views.points, width, height, lens)}};
  SizeOfImages{width, height}.AddTo(json);
  json.update(LensJson(cameras.front().model));
  return json.dump(2);
}

}  // namespace

OfflineReport CalibrateFromFiles(const OfflineCalibration& input) {
  OfflineReport report;
  if (!input.points.empty())
    report.json = FromPoints(input);
  else if (input.photographs.empty())
    throw ConfigError("calibrate: expected points or photographs, got none");
  else
    report.json =
        input.object.empty() ? FromFlatTarget(input, report.notes) : FromObject(input, report.notes);
  return report;
}

}  // namespace priamos::head
