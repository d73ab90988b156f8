#include "head/core/calibration/calibration_table.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <stdexcept>

namespace priamos::head {
namespace {

constexpr std::array kCameraNames{"left", "right"};
constexpr std::size_t kMaxSetups = 10000;

void WriteCamera(cv::FileStorage& out, const char* name, const CameraModel& camera) {
  cv::Mat matrix(3, 4, CV_64F);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) matrix.at<double>(r, c) = camera.image_from_base(r, c);
  out << name << "{"
      << "image_from_base" << matrix << "centre_u_px" << camera.centre_px.x() << "centre_v_px"
      << camera.centre_px.y() << "scale_px" << camera.scale_px << "k1" << camera.k1 << "k2" << camera.k2
      << "}";
}

void WriteSetting(cv::FileStorage& out, const HeadSetting& s) {
  out << "pan_rad" << s.pan_rad << "tilt_rad" << s.tilt_rad;
  out << "vergence_rad" << std::vector<double>(s.vergence_rad.begin(), s.vergence_rad.end());
  out << "zoom_step" << std::vector<int>(s.zoom_step.begin(), s.zoom_step.end());
  out << "focus_step" << std::vector<int>(s.focus_step.begin(), s.focus_step.end());
}

double Number(const cv::FileNode& node, const std::string& key, double low, double high) {
  const cv::FileNode value = node[key];
  const double number = value.isReal() || value.isInt() ? static_cast<double>(value) : NAN;
  if (number >= low && number <= high) return number;
  throw std::runtime_error(fmt::format("{}: expected a number, {} to {}", key, low, high));
}

template <class T>
void ReadPair(const cv::FileNode& node, const char* key, std::array<T, 2>& into) {
  std::vector<T> values;
  node[key] >> values;
  if (values.size() != 2)
    throw std::runtime_error(fmt::format("{}: expected 2 numbers, got {}", key, values.size()));
  std::copy(values.begin(), values.end(), into.begin());
}

CameraModel ReadCamera(const cv::FileNode& node) {
  CameraModel camera;
  cv::Mat matrix;
  node["image_from_base"] >> matrix;
  if (matrix.rows != 3 || matrix.cols != 4 || matrix.type() != CV_64F || !cv::checkRange(matrix))
    throw std::runtime_error("image_from_base: expected a matrix of 3x4 finite numbers");
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) camera.image_from_base(r, c) = matrix.at<double>(r, c);
  camera.centre_px = {Number(node, "centre_u_px", -1000, 5000), Number(node, "centre_v_px", -1000, 5000)};
  camera.scale_px = Number(node, "scale_px", 10, 100000);
  camera.k1 = Number(node, "k1", -2, 2);
  camera.k2 = Number(node, "k2", -2, 2);
  return camera;
}

CalibratedSetup ReadSetup(const cv::FileNode& node) {
  CalibratedSetup setup;
  setup.setting.pan_rad = Number(node, "pan_rad", -4, 4);
  setup.setting.tilt_rad = Number(node, "tilt_rad", -4, 4);
  ReadPair(node, "vergence_rad", setup.setting.vergence_rad);
  ReadPair(node, "zoom_step", setup.setting.zoom_step);
  ReadPair(node, "focus_step", setup.setting.focus_step);
  for (std::size_t i = 0; i < kCameraNames.size(); ++i) setup.cameras[i] = ReadCamera(node[kCameraNames[i]]);
  return setup;
}

}  // namespace

std::string ToYaml(const std::vector<CalibratedSetup>& setups) {
  cv::FileStorage out(".yaml",
                      cv::FileStorage::WRITE | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_YAML);
  out << "setups"
      << "[";
  for (const auto& setup : setups) {
    out << "{";
    WriteSetting(out, setup.setting);
    for (std::size_t i = 0; i < kCameraNames.size(); ++i) WriteCamera(out, kCameraNames[i], setup.cameras[i]);
    out << "}";
  }
  out << "]";
  return out.releaseAndGetString();
}

Outcome<std::vector<CalibratedSetup>> FromYaml(const std::string& text) {
  try {
    const cv::FileStorage in(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
    const cv::FileNode list = in["setups"];
    if (!list.isSeq() || list.size() == 0 || list.size() > kMaxSetups)
      return Refusal{"setups: expected a list of head setups"};
    std::vector<CalibratedSetup> setups;
    for (const auto& node : list) setups.push_back(ReadSetup(node));
    return setups;
  } catch (const cv::Exception& error) {
    return Refusal{"expected a table of head setups, got: " + error.err};
  } catch (const std::runtime_error& error) {
    return Refusal{error.what()};
  }
}

}  // namespace priamos::head
