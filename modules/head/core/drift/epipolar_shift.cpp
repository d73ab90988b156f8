#include "head/core/drift/epipolar_shift.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

namespace priamos::head {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kBandwidth_px = 0.3;
constexpr double kGridStep_px = 0.1;
constexpr int kShiftPasses = 10;

struct End {
  Vector2d at;
  double down_px;
};

/// right^T * F * left = 0.
Eigen::Matrix3d Fundamental(const CameraModel& left, const CameraModel& right) {
  const Vector3d e = Epipole(right, left);
  Eigen::Matrix3d cross;
  cross << 0, -e.z(), e.y(), e.z(), 0, -e.x(), -e.y(), e.x(), 0;
  return cross * right.image_from_base.leftCols<3>() * left.image_from_base.leftCols<3>().inverse();
}

std::vector<End> EndsOf(const CameraView& left, const CameraView& right, std::span<const StereoMatch> matches,
                        const EpipolarShiftOptions& options) {
  const Eigen::Matrix3d f = Fundamental(*left.camera, *right.camera);
  std::vector<End> ends;
  for (const StereoMatch& match : matches) {
    if (match.right.size() != 1 || match.epipolar_rad < options.min_epipolar_rad) continue;
    const ViewLine &a = left.lines[match.left], &b = right.lines[match.right.front()];
    for (const auto& [in_left, in_right] : {std::pair(a.p, b.p), std::pair(a.q, b.q)}) {
      const Vector3d line = f * in_left.homogeneous();
      const double scale = std::copysign(line.head<2>().norm(), line.y());
      const double down = line.dot(in_right.homogeneous()) / scale;
      if (std::abs(down) < options.reach_px) ends.push_back({in_right, down});
    }
  }
  return ends;
}

/// Mode of the residuals: the shift at which their density is largest.
double Densest(const std::vector<End>& ends, double reach_px) {
  double best = 0, most = 0;
  for (double at = -reach_px; at <= reach_px; at += kGridStep_px) {
    double density = 0;
    for (const End& end : ends) density += std::exp(-0.5 * std::pow((end.down_px - at) / kBandwidth_px, 2));
    if (density > most) {
      most = density;
      best = at;
    }
  }
  return best;
}

/// Tukey's biweight.
double Weight(double residual, double width) {
  const double x = residual / width;
  return std::abs(x) < 1 ? std::pow(1 - x * x, 2) : 0;
}

}  // namespace

std::optional<EpipolarShift> MeasureEpipolarShift(const CameraView& left, const CameraView& right,
                                                  std::span<const StereoMatch> matches,
                                                  const EpipolarShiftOptions& options) {
  const std::vector<End> ends = EndsOf(left, right, matches, options);
  EpipolarShift shift;
  shift.down_px = Densest(ends, options.reach_px);
  double weights = 0, weighted_squares = 0;
  for (int pass = 0; pass < kShiftPasses; ++pass) {
    double sum = 0;
    weights = weighted_squares = 0;
    shift.n = 0;
    shift.at.setZero();
    for (const End& end : ends) {
      const double residual = end.down_px - shift.down_px, weight = Weight(residual, options.core_px);
      weights += weight;
      sum += weight * residual;
      shift.at += weight * end.at;
      weighted_squares += weight * weight * residual * residual;
      shift.n += weight > 0;
    }
    if (!(weights > 0)) return std::nullopt;
    shift.down_px += sum / weights;
    shift.at /= weights;
  }
  if (shift.n < options.min_ends || shift.n < options.min_share * static_cast<double>(ends.size()))
    return std::nullopt;
  shift.sigma_px = std::hypot(std::sqrt(weighted_squares) / weights, options.floor_px);
  return shift;
}

StereoDrift Fuse(const StereoDrift& drift, const EpipolarShift& shift, const CameraModel& right) {
  const double focal = FocalLength(right);
  const Vector2d tangent = (shift.at - right.centre_px) / focal;
  // A camera that turns by w moves the image by: v by f (1 + y^2) w_x - f x y w_y - f x w_z.
  const Vector3d h =
      focal * Vector3d(1 + tangent.y() * tangent.y(), -tangent.x() * tangent.y(), -tangent.x());
  const double innovation = shift.down_px - h.dot(drift.turn_rad);
  const double variance = h.dot(drift.covariance * h) + shift.sigma_px * shift.sigma_px;
  const Vector3d gain = drift.covariance * h / variance;
  return {drift.turn_rad + gain * innovation, drift.covariance - gain * h.transpose() * drift.covariance};
}

StereoDrift UnknownDrift() {
  constexpr double kUpDown_rad = 0.1, kSideways_rad = 0.01, kRoll_rad = 0.0035;
  const Vector3d sigma(kUpDown_rad, kSideways_rad, kRoll_rad);
  return {Vector3d::Zero(), sigma.cwiseAbs2().asDiagonal()};
}

}  // namespace priamos::head
