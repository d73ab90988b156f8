#include "head/core/calibration/calibration_table.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <opencv2/core.hpp>

namespace priamos::head {

namespace {

constexpr const char* kFormat = "priamos-calibration-1";
constexpr const char* kCameras[] = {"left", "right"};
constexpr std::size_t kMostSetups = 10000;

/// What is wrong with the text, as a sentence; caught at the one place where the text comes in.
struct Damage {
  std::string reason;
};

double Number(const cv::FileNode& parent, const char* key, double min, double max) {
  const cv::FileNode node = parent[key];
  if (!node.isReal() && !node.isInt()) throw Damage{fmt::format("'{}' is missing or no number", key)};
  const double value = static_cast<double>(node);
  if (!(value >= min && value <= max)) {
    throw Damage{fmt::format("'{}' is {}, expected {} to {}", key, value, min, max)};
  }
  return value;
}

std::vector<double> Numbers(const cv::FileNode& parent, const char* key, std::size_t n, double limit) {
  const cv::FileNode node = parent[key];
  if (!node.isSeq() || node.size() != n)
    throw Damage{fmt::format("'{}' is not a list of {} numbers", key, n)};
  std::vector<double> values;
  for (const cv::FileNode& item : node) {
    if (!item.isReal() && !item.isInt())
      throw Damage{fmt::format("'{}' holds something that is no number", key)};
    values.push_back(static_cast<double>(item));
    if (!(std::abs(values.back()) <= limit)) {
      throw Damage{fmt::format("'{}' holds {}, expected -{} to {}", key, values.back(), limit, limit)};
    }
  }
  return values;
}

void Write(cv::FileStorage& file, const CameraModel& camera) {
  file << "{";
  file << "image_from_base"
       << "[:";
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) file << camera.image_from_base(row, column);
  }
  file << "]";
  file << "centre_px"
       << "[:" << camera.centre_px.x() << camera.centre_px.y() << "]";
  file << "scale_px" << camera.scale_px << "k1" << camera.k1 << "k2" << camera.k2;
  file << "}";
}

CameraModel ReadCamera(const cv::FileNode& node) {
  CameraModel camera;
  const std::vector<double> m = Numbers(node, "image_from_base", 12, 1e9);
  for (int i = 0; i < 12; ++i) camera.image_from_base(i / 4, i % 4) = m[i];
  const double direction = camera.image_from_base.block<1, 3>(2, 0).norm();
  if (!(std::abs(direction - 1) < 1e-3) || !(camera.image_from_base.leftCols<3>().determinant() > 0)) {
    throw Damage{"'image_from_base' is not the matrix of a camera"};
  }
  const std::vector<double> centre = Numbers(node, "centre_px", 2, 1e5);
  camera.centre_px = {centre[0], centre[1]};
  camera.scale_px = Number(node, "scale_px", 1, 1e6);
  camera.k1 = Number(node, "k1", -10, 10);
  camera.k2 = Number(node, "k2", -10, 10);
  return camera;
}

void Write(cv::FileStorage& file, const CalibratedSetup& setup) {
  const HeadSetting& s = setup.setting;
  file << "{";
  file << "pan_rad" << s.pan_rad << "tilt_rad" << s.tilt_rad;
  file << "vergence_rad"
       << "[:" << s.vergence_rad[0] << s.vergence_rad[1] << "]";
  file << "zoom_step"
       << "[:" << s.zoom_step[0] << s.zoom_step[1] << "]";
  file << "focus_step"
       << "[:" << s.focus_step[0] << s.focus_step[1] << "]";
  for (int i = 0; i < 2; ++i) {
    file << kCameras[i];
    Write(file, setup.cameras[i]);
  }
  file << "}";
}

CalibratedSetup ReadSetup(const cv::FileNode& node) {
  CalibratedSetup setup;
  HeadSetting& s = setup.setting;
  s.pan_rad = Number(node, "pan_rad", -7, 7);
  s.tilt_rad = Number(node, "tilt_rad", -7, 7);
  const std::vector<double> vergence = Numbers(node, "vergence_rad", 2, 7);
  const std::vector<double> zoom = Numbers(node, "zoom_step", 2, 1e6);
  const std::vector<double> focus = Numbers(node, "focus_step", 2, 1e6);
  for (int i = 0; i < 2; ++i) {
    s.vergence_rad[i] = vergence[i];
    s.zoom_step[i] = static_cast<int>(zoom[i]);
    s.focus_step[i] = static_cast<int>(focus[i]);
    setup.cameras[i] = ReadCamera(node[kCameras[i]]);
  }
  return setup;
}

std::vector<CalibratedSetup> Read(const std::string& yaml) {
  const cv::FileStorage file(yaml,
                             cv::FileStorage::READ | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_YAML);
  if (!file.isOpened() || !file["format"].isString()) throw Damage{"this is no calibration table"};
  const std::string format = file["format"];
  if (format != kFormat) throw Damage{fmt::format("the format is '{}', expected '{}'", format, kFormat)};
  const cv::FileNode list = file["setups"];
  if (!list.isSeq() || list.size() == 0) throw Damage{"the table holds no setups"};
  if (list.size() > kMostSetups) throw Damage{"the table holds too many setups"};
  // Written last: a file that was cut off does not have it.
  if (Number(file.root(), "number_of_setups", 0, kMostSetups) != static_cast<double>(list.size())) {
    throw Damage{"the table is incomplete"};
  }
  std::vector<CalibratedSetup> setups;
  for (const cv::FileNode& node : list) {
    try {
      setups.push_back(ReadSetup(node));
    } catch (const Damage& damage) {
      throw Damage{fmt::format("setup {}: {}", setups.size(), damage.reason)};
    }
  }
  return setups;
}

}  // namespace

std::string ToYaml(const std::vector<CalibratedSetup>& setups) {
  cv::FileStorage file("table.yaml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  file << "format" << kFormat << "setups"
       << "[";
  for (const CalibratedSetup& setup : setups) Write(file, setup);
  file << "]"
       << "number_of_setups" << static_cast<int>(setups.size());
  return file.releaseAndGetString();
}

Outcome<std::vector<CalibratedSetup>> FromYaml(const std::string& yaml) {
  try {
    return Read(yaml);
  } catch (const Damage& damage) {
    return Refusal{damage.reason};
  } catch (const cv::Exception&) {
    return Refusal{"the text is not YAML, or was cut off"};
  }
}

}  // namespace priamos::head
