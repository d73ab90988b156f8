#include "head/files/camera_file.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "common/config.hpp"
#include "head/core/calibration/resection/camera_parameters.hpp"
#include "head/core/calibration/rig/calibration_table.hpp"
#include "head/files/camera_text.hpp"
#include "head/files/camera_values.hpp"
#include "head/files/model_text.hpp"

namespace priamos::head {
namespace {

using Matrix34 = Eigen::Matrix<double, 3, 4>;
using Keys = std::initializer_list<const char*>;

constexpr std::size_t kMost_MB = 16;
constexpr Keys kCameraMatrix{"camera_matrix", "cameraMatrix", "Camera_Matrix", "K", "k", "M1"};
constexpr Keys kDistortion{
    "distortion_coefficients", "distCoeffs", "Distortion_Coefficients", "D", "d", "D1"};
constexpr Keys kRectification{"rectification_matrix", "R", "r"};
constexpr Keys kProjection{"projection_matrix", "P", "p"};
constexpr Keys kWidth{"image_width", "width"};
constexpr Keys kHeight{"image_height", "height"};

std::string CameraText(const std::string& path) {
  auto text = ReadText(path, "a camera (YAML, XML or JSON)", kMost_MB);
  if (!text) throw ConfigError(text.reason());
  return std::move(*text);
}

CameraValues Parse(const std::string& path, const std::string& text) {
  auto entries = ParseCameraText(text);
  if (entries) return {path, std::move(*entries)};
  const bool has_line = std::isdigit(static_cast<unsigned char>(entries.reason()[0])) != 0;
  throw ConfigError(fmt::format("{}:{}{}", path, has_line ? "" : " ", entries.reason()));
}

void CheckSize(const CameraValues& values, const std::string& below, const ImageSize& size) {
  const double width = values.Number(below, kWidth), height = values.Number(below, kHeight);
  if (width != size.width || height != size.height)
    values.Fail(*values.Find(below, kWidth), fmt::format("expected the image's size of {}x{}, got {}x{}",
                                                         size.width, size.height, width, height));
}

/// Checks that a matrix can be that of a camera: focal lengths, a centre, and a third row that is (0, 0, 1).
void CheckIntrinsics(const CameraValues& values, const CameraEntry& entry, const Eigen::Matrix3d& k,
                     const ImageSize& size) {
  const bool is_camera =
      k(0, 0) > 0 && k(1, 1) > 0 && k(1, 0) == 0 && k(2, 0) == 0 && k(2, 1) == 0 && k(2, 2) == 1;
  if (!is_camera)
    values.Fail(entry,
                "expected fu, skew, u0, 0, fv, v0, 0, 0, 1 with focal lengths above 0, got another matrix");
  // From 170 degrees across the picture to a quarter of a degree; a picture that was cut out of a larger one
  // may have its centre beside it.
  const auto is_lens = [](double focal_px, double centre_px, double size_px) {
    return focal_px >= 0.04 * size_px && focal_px <= 200 * size_px && std::abs(centre_px) <= 10 * size_px;
  };
  if (!is_lens(k(0, 0), k(0, 2), size.width) || !is_lens(k(1, 1), k(1, 2), size.height))
    values.Fail(entry, fmt::format("expected focal lengths and a centre in pixels of an image of {}x{}, got "
                                   "{:g}, {:g} and ({:g}, {:g})",
                                   size.width, size.height, k(0, 0), k(1, 1), k(0, 2), k(1, 2)));
}

/// k1, k2, p1, p2, k3, k4, k5, k6 as OpenCV has them; what follows (thin prism, tilt) must be 0.
void SetDistortion(const CameraValues& values, const std::string& below, CameraModel& camera) {
  if (const CameraEntry* model = values.Find(below, {"distortion_model"});
      model != nullptr && model->words[0] != "plumb_bob" && model->words[0] != "rational_polynomial")
    values.Fail(*model,
                fmt::format("expected plumb_bob or rational_polynomial, got {}; rectify the images, and say "
                            "--rectified",
                            model->words[0]));
  const CameraEntry* entry = values.Find(below, kDistortion);
  if (entry == nullptr) return;
  std::vector<double> d = values.Numbers(below, kDistortion, 0);
  constexpr std::array<std::size_t, 5> kCounts{4, 5, 8, 12, 14};
  if (std::ranges::find(kCounts, d.size()) == kCounts.end() &&
      std::ranges::any_of(d, [](double k) { return k != 0; }))
    values.Fail(*entry,
                fmt::format("expected 4, 5 or 8 numbers (k1 k2 p1 p2 k3 k4 k5 k6), got {}", d.size()));
  if (d.size() > 8 && std::any_of(d.begin() + 8, d.end(), [](double k) { return k != 0; }))
    values.Fail(*entry,
                "expected no thin prism and no tilt of the sensor, got some; rectify the images, and say "
                "--rectified");
  d.resize(8);
  camera.k1 = d[0];
  camera.k2 = d[1];
  camera.bend.p1 = d[2];
  camera.bend.p2 = d[3];
  camera.bend.k3 = d[4];
  camera.bend.k4 = d[5];
  camera.bend.k5 = d[6];
  camera.bend.k6 = d[7];
}

void SetCentre(const Eigen::Matrix3d& k, CameraModel& camera) {
  camera.centre_px = k.block<2, 1>(0, 2);
  camera.scale_px = k(0, 0);
  if (camera.bend != LensBend() || camera.k1 != 0 || camera.k2 != 0) camera.bend.aspect = k(1, 1) / k(0, 0);
}

/// A camera of rectified images.
CameraModel RectifiedCamera(const CameraValues& values, const std::string& below, const ImageSize& size) {
  CameraModel camera;
  camera.image_from_base = values.Projection(below, kProjection);
  if (!(std::abs(camera.image_from_base.leftCols<3>().determinant()) > 1e-9))
    values.Fail(*values.Find(below, kProjection), "expected a camera, got a singular matrix");
  camera.centre_px = size.Centre();
  return camera;
}

/// A camera of images as it took them. Where a projection matrix says where the camera stands beside another
/// one, the base frame is that of both rectified cameras.
CameraModel RawCamera(const CameraValues& values, const std::string& below, const ImageSize& size) {
  CameraModel camera;
  const Eigen::Matrix3d k = values.Matrix(below, kCameraMatrix);
  CheckIntrinsics(values, *values.Find(below, kCameraMatrix), k, size);
  SetDistortion(values, below, camera);
  SetCentre(k, camera);
  Matrix34 camera_from_base = Matrix34::Identity();
  if (values.Has(below, kProjection)) {
    const Matrix34 p = values.Projection(below, kProjection);
    if (!(std::abs(p.leftCols<3>().determinant()) > 1e-9))
      values.Fail(*values.Find(below, kProjection), "expected a camera, got a singular matrix");
    camera_from_base.col(3) = p.leftCols<3>().inverse() * p.col(3);
    if (values.Has(below, kRectification)) {
      const Eigen::Matrix3d turn = values.Matrix(below, kRectification);
      if (!(turn * turn.transpose()).isIdentity(1e-3))
        values.Fail(*values.Find(below, kRectification), "expected a rotation, got another matrix");
      camera_from_base = turn.transpose() * camera_from_base;
    }
  }
  camera.image_from_base = k * camera_from_base;
  return camera;
}

/// OpenCV's and ROS's files.
CameraModel StandardCamera(const CameraValues& values, const CameraFileOptions& options) {
  CheckSize(values, "", options.size);
  if (options.are_rectified || !values.Has("", kCameraMatrix)) {
    if (!options.are_rectified && values.Has("", kDistortion))
      for (const double d : values.Numbers("", kDistortion, 0))
        if (d != 0)
          values.Fail(*values.Find("", kDistortion),
                      "expected a camera_matrix beside it, got none; of rectified "
                      "images say --rectified");
    return RectifiedCamera(values, "", options.size);
  }
  return RawCamera(values, "", options.size);
}

/// The element that holds ViSP's numbers: the model with distortion, if there is one; of a tracker's
/// configuration the camera itself.
std::string VispModel(const CameraValues& values) {
  std::string found = "camera";
  for (const char* model : {"camera/model", "camera/model#2", "camera/model#3"}) {
    const CameraEntry* type = values.Find(model, {"type"});
    if (type == nullptr) continue;
    if (type->words[0] == "perspectiveProjWithDistortion") return model;
    if (type->words[0] == "perspectiveProjWithoutDistortion") found = model;
    if (found == "camera")
      values.Fail(*type, "expected perspectiveProjWithDistortion or ...WithoutDistortion, got " +
                             type->words[0] + "; rectify the images");
  }
  return found;
}

CameraModel VispCamera(const CameraValues& values, const CameraFileOptions& options) {
  if (values.Has("camera", kWidth)) CheckSize(values, "camera", options.size);  // a tracker's file has none
  const std::string model = VispModel(values);
  Eigen::Matrix3d k;
  k << values.Number(model, {"px"}), 0, values.Number(model, {"u0"}), 0, values.Number(model, {"py"}),
      values.Number(model, {"v0"}), 0, 0, 1;
  CheckIntrinsics(values, *values.Find(model, {"px"}), k, options.size);
  CameraModel camera;
  if (!options.are_rectified && values.Has(model, {"kud"})) camera.k1 = values.Number(model, {"kud"});
  SetCentre(k, camera);
  camera.image_from_base << k, Eigen::Vector3d::Zero();
  return camera;
}

/// What `priamos calibrate` found from files, below `below`.
CameraModel CalibratedCamera(const CameraValues& values, const std::string& below, const ImageSize& size) {
  CheckSize(values, below, size);
  CameraModel camera;
  const Eigen::Matrix3d k = values.Matrix(below, {"K"});
  CheckIntrinsics(values, *values.Find(below, {"K"}), k, size);
  camera.image_from_base << k, Eigen::Vector3d::Zero();
  if (values.Has(below, {"image_from_points"}))
    camera.image_from_base = values.Projection(below, {"image_from_points"});
  camera.centre_px = k.block<2, 1>(0, 2);
  camera.scale_px = k(0, 0);
  camera.k1 = values.Number(below, {"k1"});
  camera.k2 = values.Number(below, {"k2"});
  return camera;
}

/// Moves the base frame into the first camera, unless it is there.
void PutFirstIntoBase(std::vector<CameraModel>& cameras) {
  const auto first = ExtractParameters(cameras.front().image_from_base);
  if (!first || first->centre_m.norm() < 1e-9) return;
  Eigen::Isometry3d base_from_first = Eigen::Isometry3d::Identity();
  base_from_first.linear() = first->camera_from_base.transpose();
  base_from_first.translation() = first->centre_m;
  for (CameraModel& camera : cameras)
    camera.image_from_base = camera.image_from_base * base_from_first.matrix();
}

std::vector<CameraModel> CamerasOfTable(const std::string& path, const std::string& text, std::size_t n,
                                        const ImageSize& size) {
  if (const ImageSize kastor; size.width != kastor.width || size.height != kastor.height)
    throw ConfigError(fmt::format("{}: expected images of its head of {}x{} pixels, got {}x{}", path,
                                  kastor.width, kastor.height, size.width, size.height));
  const auto head = FromYaml(text);
  if (!head) throw ConfigError(fmt::format("{}: {}", path, head.reason()));
  HeadSetting rest;
  for (int c = 0; c < 2; ++c)
    if (!head->lenses[c].zoom_steps().empty()) {
      rest.zoom_step[c] = head->lenses[c].zoom_steps().front();
      rest.focus_step[c] = head->lenses[c].focus_steps().front();
    }
  std::vector<CameraModel> cameras;
  for (std::size_t c = 0; c < std::min<std::size_t>(n, kCameras); ++c) {
    const auto camera = head->CameraAt(rest, static_cast<int>(c));
    if (!camera) throw ConfigError(fmt::format("{}: {} camera: {}", path, kCameraNames[c], camera.reason()));
    cameras.push_back(*camera);
  }
  PutFirstIntoBase(cameras);
  return cameras;
}

/// All cameras of one file, at most `n`.
std::vector<CameraModel> CamerasOf(const std::string& path, std::size_t n, const CameraFileOptions& options) {
  const std::string text = CameraText(path);
  const CameraValues values = Parse(path, text);
  if (const CameraEntry* format = values.Find("", {"format"});
      format != nullptr && format->words[0].starts_with("priamos-calibration"))
    return CamerasOfTable(path, text, n, options.size);
  if (values.Has("camera/model", {"type"}) || values.Has("camera", {"px"}))
    return {VispCamera(values, options)};
  if (values.Has("", {"F_px"})) return {CalibratedCamera(values, "", options.size)};
  std::vector<CameraModel> cameras;
  for (std::size_t i = 0; i < n && values.Has(fmt::format("cameras/{}", i), {"K"}); ++i)
    cameras.push_back(CalibratedCamera(values, fmt::format("cameras/{}", i), options.size));
  if (cameras.empty()) return {StandardCamera(values, options)};
  PutFirstIntoBase(cameras);
  return cameras;
}

}  // namespace

std::vector<CameraModel> LoadCameras(const std::vector<std::string>& files, std::size_t n,
                                     const CameraFileOptions& options) {
  std::vector<CameraModel> cameras;
  for (const std::string& file : files) {
    const auto of_file = CamerasOf(file, files.size() == 1 ? n : 1, options);
    cameras.insert(cameras.end(), of_file.begin(), of_file.end());
  }
  return cameras;
}

}  // namespace priamos::head
