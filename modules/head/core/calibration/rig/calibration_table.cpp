#include "head/core/calibration/rig/calibration_table.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "common/principal_axes.hpp"

namespace priamos::head {

namespace {

constexpr const char* kFormat = "priamos-calibration-2";
constexpr std::size_t kMostNodes = 10000, kMostLasers = 4;

/// What is wrong with the text, as a sentence; caught at the one place where the text comes in.
struct Damage {
  std::string reason;
};

double Number(const cv::FileNode& parent, const std::string& key, double min, double max) {
  const cv::FileNode node = parent[key];
  if (!node.isReal() && !node.isInt()) throw Damage{fmt::format("'{}' is missing or no number", key)};
  const double value = static_cast<double>(node);
  if (!(value >= min && value <= max)) {
    throw Damage{fmt::format("'{}' is {}, expected {} to {}", key, value, min, max)};
  }
  return value;
}

std::vector<double> Numbers(const cv::FileNode& parent, const std::string& key, double limit) {
  const cv::FileNode node = parent[key];
  if (!node.isSeq() || node.size() > kMostNodes) throw Damage{fmt::format("'{}' is not a list", key)};
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

/// Visits the numbers of the mechanics by name: written and read by the same list.
template <class Geometry, class Visit>
void ForEachNumber(Geometry& g, const Visit& visit) {
  visit("x_m", g.x_m, 10.0);
  visit("y_m", g.y_m, 10.0);
  visit("z_m", g.z_m, 10.0);
  visit("roll_rad", g.roll_rad, 7.0);
  visit("pitch_rad", g.pitch_rad, 7.0);
  visit("yaw_rad", g.yaw_rad, 7.0);
  visit("tilt_axis_x_m", g.tilt_axis_x_m, 1.0);
  visit("tilt_axis_roll_rad", g.tilt_axis_roll_rad, 7.0);
}
template <class Mount, class Visit>
void ForEachMountNumber(Mount& m, const Visit& visit) {
  visit("x_m", m.x_m, 10.0);
  visit("y_m", m.y_m, 10.0);
  visit("z_m", m.z_m, 10.0);
  visit("axis_roll_rad", m.axis_roll_rad, 7.0);
  visit("axis_pitch_rad", m.axis_pitch_rad, 7.0);
  visit("side_m", m.side_m, 1.0);
  visit("roll_rad", m.roll_rad, 7.0);
  visit("pitch_rad", m.pitch_rad, 7.0);
  visit("yaw_rad", m.yaw_rad, 7.0);
}

void WriteNode(cv::FileStorage& file, int zoom, int focus, const LensState& lens) {
  file << "{:";
  file << "zoom_step" << zoom << "focus_step" << focus << "focal_px" << lens.focal_px << "u_px"
       << lens.centre_px.x() << "v_px" << lens.centre_px.y() << "k1" << lens.k1 << "k2" << lens.k2
       << "pupil_m" << lens.pupil_m;
  file << "}";
}

void WriteCamera(cv::FileStorage& file, const CameraMount& mount, const LensTable& lens) {
  file << "{";
  ForEachMountNumber(mount, [&](const char* key, double value, double) { file << key << value; });
  file << "zoom_steps" << lens.zoom_steps() << "focus_steps" << lens.focus_steps();
  file << "nodes"
       << "[";
  const std::size_t n = lens.focus_steps().size();
  for (std::size_t i = 0; i < lens.nodes().size(); ++i)
    WriteNode(file, lens.zoom_steps()[i / n], lens.focus_steps()[i % n], lens.nodes()[i]);
  file << "]"
       << "}";
}

LensState ReadNode(const cv::FileNode& node, int zoom, int focus) {
  if (Number(node, "zoom_step", 0, 1e6) != zoom || Number(node, "focus_step", 0, 1e6) != focus)
    throw Damage{"'zoom_step' and 'focus_step' do not follow the grid"};
  return {Number(node, "focal_px", 1, 1e6),
          {Number(node, "u_px", -1e5, 1e5), Number(node, "v_px", -1e5, 1e5)},
          Number(node, "k1", -10, 10),
          Number(node, "k2", -10, 10),
          Number(node, "pupil_m", -1, 1)};
}

std::vector<int> ReadSteps(const cv::FileNode& camera, const char* key) {
  std::vector<int> steps;
  for (const double step : Numbers(camera, key, 1e6)) {
    if (step != std::floor(step) || (!steps.empty() && step <= steps.back()))
      throw Damage{fmt::format("'{}' are not ascending whole steps", key)};
    steps.push_back(static_cast<int>(step));
  }
  return steps;
}

void ReadCamera(const cv::FileNode& node, CameraMount& mount, LensTable& table) {
  ForEachMountNumber(mount,
                     [&](const char* key, double& v, double limit) { v = Number(node, key, -limit, limit); });
  const std::vector<int> zoom = ReadSteps(node, "zoom_steps"), focus = ReadSteps(node, "focus_steps");
  const cv::FileNode list = node["nodes"];
  const std::size_t n = zoom.size() * focus.size();
  if (n == 0 && zoom.empty() && focus.empty()) return;  // not calibrated
  if (n == 0 || n > kMostNodes || !list.isSeq() || list.size() != n)
    throw Damage{fmt::format("'nodes' are not {} by {}", zoom.size(), focus.size())};
  std::vector<LensState> nodes;
  for (std::size_t i = 0; i < n; ++i) {
    try {
      nodes.push_back(ReadNode(list[static_cast<int>(i)], zoom[i / focus.size()], focus[i % focus.size()]));
    } catch (const Damage& damage) {
      throw Damage{fmt::format("node {}: {}", i, damage.reason)};
    }
  }
  table = LensTable(zoom, focus, std::move(nodes));
}

Eigen::Matrix<double, 6, 6> ReadCovariance(const cv::FileNode& root) {
  const std::vector<double> values = Numbers(root, "base_covariance", 100);
  if (values.size() != 36) throw Damage{"'base_covariance' is not a list of 36 numbers"};
  Eigen::Matrix<double, 6, 6> c = Eigen::Map<const Eigen::Matrix<double, 6, 6>>(values.data());
  const auto variances = PrincipalAxesOf(c).values;
  if ((c - c.transpose()).norm() > 1e-9 * c.norm() || !(variances(0) >= -1e-9 * variances(5))) {
    throw Damage{"'base_covariance' is no covariance"};
  }
  return c;
}

Eigen::Vector3d ReadVector(const cv::FileNode& parent, const std::string& key) {
  const std::vector<double> values = Numbers(parent, key, 100);
  if (values.size() != 3) throw Damage{fmt::format("'{}' is not a list of 3 numbers", key)};
  return {values[0], values[1], values[2]};
}

LaserPlane ReadLaser(const cv::FileNode& node) {
  LaserPlane laser;
  laser.normal = ReadVector(node, "normal");
  if (!(std::abs(laser.normal.norm() - 1) < 1e-6)) throw Damage{"laser: 'normal' is not of length 1"};
  laser.offset_m = Number(node, "offset_m", -100, 100);
  laser.pivot_m = ReadVector(node, "pivot_m");
  laser.sigma_turn_rad = Number(node, "sigma_turn_rad", 0, 1);
  laser.sigma_shift_m = Number(node, "sigma_shift_m", 0, 1);
  if (!laser.MeetsFloorAhead())
    throw Damage{fmt::format(
        "laser: its light meets the floor {:.2f} m ahead of the base centre, expected {} to {} m; calibrate "
        "it anew with `priamos calibrate --laser`",
        laser.FloorAhead_m(), kNearestLight_m, kFarthestLight_m)};
  return laser;
}

/// Absent in tables of heads whose lasers were not calibrated. Tables of one laser have `laser`, as they had
/// when there was only one.
std::vector<LaserPlane> ReadLasers(const cv::FileNode& root) {
  const cv::FileNode one = root["laser"], list = root["lasers"];
  std::vector<LaserPlane> lasers;
  if (!one.empty()) lasers.push_back(ReadLaser(one));
  if (list.empty()) return lasers;
  if (!list.isSeq() || list.size() > kMostLasers) throw Damage{"'lasers' is not a list of 1 to 4"};
  for (const cv::FileNode& node : list) lasers.push_back(ReadLaser(node));
  return lasers;
}

void WriteLaser(cv::FileStorage& file, const LaserPlane& laser) {
  const auto write = [&](const char* key, const Eigen::Vector3d& v) {
    file << key << "[:" << v.x() << v.y() << v.z() << "]";
  };
  file << "{:";
  write("normal", laser.normal);
  file << "offset_m" << laser.offset_m;
  write("pivot_m", laser.pivot_m);
  file << "sigma_turn_rad" << laser.sigma_turn_rad << "sigma_shift_m" << laser.sigma_shift_m << "}";
}

void WriteLasers(cv::FileStorage& file, const std::vector<LaserPlane>& lasers) {
  if (lasers.empty()) return;
  file << "lasers"
       << "[";
  for (const LaserPlane& laser : lasers) WriteLaser(file, laser);
  file << "]";
}

int CountNodes(const HeadModel& model) {
  std::size_t n = 0;
  for (const LensTable& lens : model.lenses) n += lens.nodes().size();
  return static_cast<int>(n);
}

HeadModel Read(const std::string& yaml) {
  const cv::FileStorage file(yaml,
                             cv::FileStorage::READ | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_YAML);
  if (!file.isOpened() || !file["format"].isString()) throw Damage{"this is no calibration table"};
  const std::string format = file["format"];
  if (format != kFormat) throw Damage{fmt::format("the format is '{}', expected '{}'", format, kFormat)};
  HeadModel model;
  const cv::FileNode head = file["head"];
  ForEachNumber(model.geometry,
                [&](const char* key, double& v, double limit) { v = Number(head, key, -limit, limit); });
  for (int c = 0; c < kCameras; ++c) {
    try {
      ReadCamera(file[kCameraNames[c]], model.geometry.cameras[c], model.lenses[c]);
    } catch (const Damage& damage) {
      throw Damage{fmt::format("{} camera: {}", kCameraNames[c], damage.reason)};
    }
  }
  model.lasers = ReadLasers(file.root());
  model.base_covariance = ReadCovariance(file.root());
  // Written last: a file that was cut off does not have it.
  if (Number(file.root(), "number_of_nodes", 1, kMostNodes) != CountNodes(model))
    throw Damage{"the table is incomplete"};
  return model;
}

}  // namespace

std::string ToYaml(const HeadModel& model) {
  cv::FileStorage file("table.yaml", cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
  file << "format" << kFormat << "head"
       << "{";
  ForEachNumber(model.geometry, [&](const char* key, double value, double) { file << key << value; });
  file << "}";
  for (int c = 0; c < kCameras; ++c) {
    file << kCameraNames[c];
    WriteCamera(file, model.geometry.cameras[c], model.lenses[c]);
  }
  WriteLasers(file, model.lasers);
  file << "base_covariance"
       << "[:";
  for (int i = 0; i < 36; ++i) file << model.base_covariance(i % 6, i / 6);
  file << "]"
       << "number_of_nodes" << CountNodes(model);
  return file.releaseAndGetString();
}

Outcome<HeadModel> FromYaml(const std::string& yaml) {
  try {
    return Read(yaml);
  } catch (const Damage& damage) {
    return Refusal{damage.reason};
  } catch (const cv::Exception&) {
    return Refusal{"the text is not YAML, or was cut off"};
  }
}

}  // namespace priamos::head
