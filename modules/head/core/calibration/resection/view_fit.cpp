#include "head/core/calibration/resection/view_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace priamos::head {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kParameters = 10;  // rotation 3, offset 3, log focal, centre 2, k1
using Normal = Eigen::Matrix<double, kParameters, kParameters>;
using Rhs = Eigen::Matrix<double, kParameters, 1>;
using Jacobian = Eigen::Matrix<double, 2, kParameters>;

constexpr double kHopeless_px = 1e9;
constexpr double kNearest_m = 1e-3;

Matrix3d Hat(const Vector3d& x) {
  return (Matrix3d() << 0, -x.z(), x.y(), x.z(), 0, -x.x(), -x.y(), x.x(), 0).finished();
}

/// Derivatives of the image of `in_camera` (which has rotated part `turned`).
Jacobian Derivatives(const PinholeView& view, const Vector3d& in_camera, const Vector3d& turned) {
  const double z = in_camera.z(), x = in_camera.x() / z, y = in_camera.y() / z;
  const double r2 = x * x + y * y, stretch = 1 + view.k1 * r2;
  Eigen::Matrix<double, 2, 3> ray;
  ray << 1 / z, 0, -x / z, 0, 1 / z, -y / z;
  Eigen::Matrix2d bend;
  bend << stretch + 2 * view.k1 * x * x, 2 * view.k1 * x * y, 2 * view.k1 * x * y,
      stretch + 2 * view.k1 * y * y;
  const Eigen::Matrix<double, 2, 3> per_point = view.focal_px * bend * ray;
  Jacobian j;
  j.leftCols<3>() = -per_point * Hat(turned);
  j.middleCols<3>(3) = per_point;
  j.col(6) = view.focal_px * stretch * Vector2d(x, y);
  j.middleCols<2>(7).setIdentity();
  j.col(9) = view.focal_px * r2 * Vector2d(x, y);
  return j;
}

void AddPrior(int i, double error, double sigma, Normal& n, Rhs& rhs) {
  // A fixed parameter is one with a very narrow prior around what it is.
  const double weight = sigma > 0 ? 1 / (sigma * sigma) : 1e18;
  n(i, i) += weight;
  if (sigma > 0) rhs(i) += weight * error;
}

void AddPriors(const PinholeView& view, const LensPrior& prior, Normal& n, Rhs& rhs) {
  AddPrior(6, std::log(prior.focal_px / view.focal_px), prior.focal_log_sigma, n, rhs);
  AddPrior(7, prior.centre_px.x() - view.centre_px.x(), prior.centre_sigma_px, n, rhs);
  AddPrior(8, prior.centre_px.y() - view.centre_px.y(), prior.centre_sigma_px, n, rhs);
  AddPrior(9, -view.k1, prior.k1_sigma, n, rhs);
}

void Apply(const Rhs& step, PinholeView& view) {
  const Vector3d turn = step.head<3>();
  const double angle = turn.norm();
  if (angle > 0) {
    view.camera_from_object = Eigen::AngleAxisd(angle, turn / angle) * view.camera_from_object;
  }
  view.offset_m += step.segment<3>(3);
  view.focal_px *= std::exp(std::clamp(step(6), -0.5, 0.5));
  view.centre_px += step.segment<2>(7);
  view.k1 += step(9);
}

/// One Gauss-Newton step; returns the weighted RMS before it.
double Step(PinholeView& view, std::span<const PointPair> pairs, const LensPrior& prior, double sigma_px) {
  Normal n = Normal::Zero();
  Rhs rhs = Rhs::Zero();
  double squares = 0, weights = 0;
  for (const PointPair& p : pairs) {
    const Vector3d turned = view.camera_from_object * p.point_m, in_camera = turned + view.offset_m;
    if (!(in_camera.z() > kNearest_m)) return kHopeless_px;
    const Vector2d error = p.image_px - view.Project(p.point_m);
    const double cauchy = 1 / (1 + error.squaredNorm() / (sigma_px * sigma_px));
    const double weight = cauchy / (sigma_px * sigma_px);
    const Jacobian j = Derivatives(view, in_camera, turned);
    n += (weight * j.transpose()).lazyProduct(j);
    rhs += weight * j.transpose().lazyProduct(error);
    squares += cauchy * error.squaredNorm();
    weights += cauchy;
  }
  AddPriors(view, prior, n, rhs);
  n.diagonal() *= 1 + 1e-9;
  const Rhs step = n.ldlt().solve(rhs);
  if (!step.allFinite()) return kHopeless_px;
  Apply(step, view);
  return std::sqrt(squares / weights);
}

/// Scaled orthography: rotation, and pixels per metre.
struct Orthography {
  Matrix3d rotation;
  double px_per_m;
  Vector3d mean_m;
  Vector2d mean_px;
};

Orthography FitOrthography(std::span<const PointPair> pairs) {
  Vector3d mean_m = Vector3d::Zero();
  Vector2d mean_px = Vector2d::Zero();
  for (const PointPair& p : pairs) {
    mean_m += p.point_m / pairs.size();
    mean_px += p.image_px / pairs.size();
  }
  Matrix3d scatter = Matrix3d::Zero();
  Eigen::Matrix<double, 2, 3> cross = Eigen::Matrix<double, 2, 3>::Zero();
  for (const PointPair& p : pairs) {
    const Vector3d x = p.point_m - mean_m;
    scatter += x * x.transpose();
    cross += (p.image_px - mean_px) * x.transpose();
  }
  const Eigen::Matrix<double, 2, 3> affine = scatter.ldlt().solve(cross.transpose()).transpose();
  // The nearest pair of orthonormal rows: the polar factor.
  const Eigen::Matrix2d square = affine * affine.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(square);
  const Eigen::Matrix<double, 2, 3> rows = solver.operatorInverseSqrt() * affine;
  Orthography result{Matrix3d::Zero(), solver.eigenvalues().cwiseSqrt().mean(), mean_m, mean_px};
  result.rotation.topRows<2>() = rows;
  result.rotation.row(2) = rows.row(0).cross(rows.row(1));
  return result;
}

PinholeView StartFrom(const Orthography& o, double focal_px) {
  PinholeView view;
  view.camera_from_object = o.rotation;
  view.focal_px = focal_px;
  view.centre_px = o.mean_px;
  view.offset_m = Vector3d(0, 0, focal_px / o.px_per_m) - o.rotation * o.mean_m;
  return view;
}

}  // namespace

Vector2d PinholeView::Project(const Vector3d& in_object) const {
  const Vector2d ray = InCamera(in_object).hnormalized();
  return centre_px + focal_px * (1 + k1 * ray.squaredNorm()) * ray;
}

CameraModel PinholeView::Model() const {
  Matrix3d k;
  k << focal_px, 0, centre_px.x(), 0, focal_px, centre_px.y(), 0, 0, 1;
  CameraModel model;
  model.image_from_base << k * camera_from_object, k * offset_m;
  model.centre_px = centre_px;
  model.scale_px = focal_px;
  model.k1 = k1;
  return model;
}

double FitView(PinholeView& view, std::span<const PointPair> pairs, const LensPrior& prior, int steps,
               double sigma_px) {
  double rms = kHopeless_px;
  for (int i = 0; i < steps; ++i) {
    rms = Step(view, pairs, prior, sigma_px);
    if (rms == kHopeless_px) return rms;
  }
  PinholeView probe = view;
  return Step(probe, pairs, prior, sigma_px);
}

Outcome<PinholeView> FitViewFromPoints(std::span<const PointPair> pairs) {
  const Orthography start = FitOrthography(pairs);
  double extent_px = 0;
  for (const PointPair& p : pairs) extent_px += (p.image_px - start.mean_px).norm() / pairs.size();
  PinholeView best;
  double best_rms = kHopeless_px;
  for (const double focal_px : {600.0, 1200.0, 2400.0}) {
    PinholeView view = StartFrom(start, focal_px);
    const LensPrior prior{focal_px, 0.4, start.mean_px, 200, 0};
    const double rms = FitView(view, pairs, prior, 15, 0.02 * extent_px);
    if (rms < best_rms) {
      best_rms = rms;
      best = view;
    }
  }
  if (best_rms > 0.02 * extent_px) return Refusal{"no camera with square pixels comes near the points"};
  return best;
}

}  // namespace priamos::head
