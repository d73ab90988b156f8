#include "head/core/calibration/rig/laser_calibration.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "common/principal_axes.hpp"

namespace priamos::head {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Plane = Eigen::Hyperplane<double, 3>;

constexpr std::size_t kFewestPoints = 30;
constexpr double kLightSigma_px = 0.03;  // what the model of light and lens leaves out
constexpr double kConsensus_px = 1.5;    // for the first plane
constexpr double kOutlier_px = 0.6;      // beyond 4 sigma
constexpr double kFewestInliers = 0.6;   // of all points
constexpr double kNarrowest = 0.03;      // spread across the longest direction, as a share of that along it
constexpr double kLeastSpread_m = 0.003;
constexpr double kWorstLight_px = 1;
constexpr std::size_t kTries = 300, kTested = 500;
constexpr int kSteps = 8;

/// One line of sight where it meets its board.
struct LightPoint {
  Vector3d at, per_px,
      per_board_m;  ///< the point; how it moves with the row of the image, and with the board
  double sigma_px;
  std::size_t view;
};

/// Distance from the plane in rows of the image.
double RowsFrom(const Plane& plane, const LightPoint& p) {
  return plane.signedDistance(p.at) / plane.normal().dot(p.per_px);
}

/// How the point moves when the board moves along its normal, per metre.
Vector3d PerBoard(const StripeView& view, const Eigen::Vector2d& px, const Vector3d& at) {
  constexpr double kStep_m = 1e-4;
  const Plane moved(view.board.normal(), view.board.offset() - kStep_m);
  const auto there = PointOnPlane(view.camera, px, moved);
  return there ? Vector3d((*there - at) / kStep_m) : Vector3d::Zero();
}

Outcome<std::vector<LightPoint>> PointsOf(std::span<const StripeView> views) {
  std::vector<LightPoint> points;
  for (std::size_t k = 0; k < views.size(); ++k) {
    const StripeView& view = views[k];
    if (!view.camera.image_from_base.allFinite() || !view.board.coeffs().allFinite())
      return Refusal{fmt::format("view {}: camera or board is not a finite number", k + 1)};
    for (const StripePoint& p : view.points) {
      const auto at = PointOnPlane(view.camera, p.at, view.board);
      const auto above = PointOnPlane(view.camera, p.at - Eigen::Vector2d(0, 0.5), view.board);
      const auto below = PointOnPlane(view.camera, p.at + Eigen::Vector2d(0, 0.5), view.board);
      if (!at || !above || !below)
        return Refusal{fmt::format(
            "view {}: the board is seen edge-on, or the line is not where the board can be", k + 1)};
      points.push_back(
          {*at, *below - *above, PerBoard(view, p.at, *at), std::hypot(p.sigma_px, kLightSigma_px), k});
    }
  }
  if (points.size() < kFewestPoints)
    return Refusal{
        fmt::format("{} points of the laser's line, expected at least {}", points.size(), kFewestPoints)};
  return points;
}

/// The plane through three points that most others lie in.
std::optional<Plane> PlaneOfMost(const std::vector<LightPoint>& points) {
  const std::size_t n = points.size(), stride = std::max<std::size_t>(1, n / kTested);
  std::optional<Plane> best;
  int most = 0;
  for (std::size_t i = 0; i < kTries; ++i) {
    // Spread evenly over all triples, and the same every time: irrational strides.
    const auto pick = [&](double step) { return static_cast<std::size_t>(std::fmod((i + 1) * step, 1) * n); };
    const Vector3d &a = points[pick(0.8191725134)].at, &b = points[pick(0.6710436067)].at,
                   &c = points[pick(0.5497004779)].at;
    const Vector3d normal = (b - a).cross(c - a);
    if (normal.norm() < 1e-9) continue;
    const Plane plane(normal.normalized(), a);
    int agree = 0;
    for (std::size_t k = 0; k < n; k += stride) agree += std::abs(RowsFrom(plane, points[k])) < kConsensus_px;
    if (agree > most) {
      most = agree;
      best = plane;
    }
  }
  return best;
}

/// Marks what lies in the plane.
std::vector<bool> Inliers(const std::vector<LightPoint>& points, const Plane& plane, double at_least_px) {
  std::vector<bool> inside;
  inside.reserve(points.size());
  for (const LightPoint& p : points)
    inside.push_back(std::abs(RowsFrom(plane, p)) < std::max(at_least_px, 4 * p.sigma_px));
  return inside;
}

struct Spread {
  Vector3d middle = Vector3d::Zero();
  Vector3d rms_m = Vector3d::Zero();  ///< along the principal axes, ascending
};

Spread SpreadOf(const std::vector<LightPoint>& points, const std::vector<bool>& used) {
  Spread s;
  double n = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (used[i]) {
      s.middle += points[i].at;
      n += 1;
    }
  }
  s.middle /= std::max(n, 1.0);
  Matrix3d scatter = Matrix3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (used[i]) scatter += (points[i].at - s.middle) * (points[i].at - s.middle).transpose() / n;
  }
  s.rms_m = PrincipalAxesOf(scatter).values.cwiseMax(0).cwiseSqrt();
  return s;
}

/// Two turns and a shift: what moves a plane about a point within it.
struct Motion {
  Vector3d axis1, axis2, pivot;

  Motion(const Plane& plane, const Vector3d& middle)
      : axis1(plane.normal().unitOrthogonal()),
        axis2(plane.normal().cross(axis1)),
        pivot(plane.projection(middle)) {}
  /// How the distance of a point, in rows, follows the three.
  Vector3d Derivative(const Plane& plane, const LightPoint& p) const {
    const Vector3d arm = p.at - pivot;
    return Vector3d(axis1.dot(arm), axis2.dot(arm), -1) / plane.normal().dot(p.per_px);
  }
  Plane Moved(const Plane& plane, const Vector3d& step) const {
    const Vector3d normal = (plane.normal() + step.x() * axis1 + step.y() * axis2).normalized();
    return Plane(normal, pivot + step.z() * plane.normal());
  }
};

Plane Refine(const std::vector<LightPoint>& points, const std::vector<bool>& used, const Vector3d& middle,
             Plane plane) {
  for (int step = 0; step < kSteps; ++step) {
    const Motion motion(plane, middle);
    Matrix3d normal = Matrix3d::Zero();
    Vector3d right = Vector3d::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!used[i]) continue;
      const double weight = 1 / (points[i].sigma_px * points[i].sigma_px);
      const Vector3d j = motion.Derivative(plane, points[i]);
      normal += weight * j * j.transpose();
      right -= weight * RowsFrom(plane, points[i]) * j;
    }
    plane = motion.Moved(plane, normal.ldlt().solve(right));
  }
  return plane;
}

/// Information of one view: its points measure its line once, however many they are.
struct ViewInformation {
  Matrix3d motion = Matrix3d::Zero();
  double n = 0, rows2_by_board = 0;  ///< square of how far the line moves with the board's error
};

/// Standard deviations of a plane that is already right.
void FillSigmas(const std::vector<LightPoint>& points, const std::vector<bool>& used,
                std::span<const StripeView> views, double rms_px, const Motion& motion, LaserPlane& laser) {
  const Plane plane = laser.Plane();
  std::vector<ViewInformation> of_view(views.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!used[i]) continue;
    const LightPoint& p = points[i];
    const Vector3d j = motion.Derivative(plane, p);
    const double rows =
        plane.normal().dot(p.per_board_m) / plane.normal().dot(p.per_px) * views[p.view].board_sigma_m;
    of_view[p.view].motion += j * j.transpose();
    of_view[p.view].rows2_by_board += rows * rows;
    of_view[p.view].n += 1;
  }
  // Every line gives two numbers, its place and its slope; three are spent on the plane.
  const auto lines = static_cast<double>(
      std::count_if(of_view.begin(), of_view.end(), [](const auto& v) { return v.n > 0; }));
  const double shown = rms_px * rms_px * 2 * lines / std::max(1.0, 2 * lines - 3);
  Matrix3d information = Matrix3d::Zero();
  for (const ViewInformation& v : of_view) {
    if (v.n == 0) continue;
    const double variance = std::max(shown, v.rows2_by_board / v.n) + kLightSigma_px * kLightSigma_px;
    information += v.motion / v.n / variance;
  }
  const Matrix3d covariance = information.inverse();
  const PrincipalAxes<2> turns = PrincipalAxesOf<2>(covariance.topLeftCorner<2, 2>());
  laser.sigma_turn_rad = std::sqrt(std::max(0.0, turns.values(1)));
  laser.sigma_shift_m = std::sqrt(std::max(0.0, covariance(2, 2)));
}

void FillErrors(const std::vector<LightPoint>& points, const std::vector<bool>& used, std::size_t views,
                LaserCalibration& result) {
  const Plane plane = result.plane.Plane();
  std::vector<double> squares(views, 0), n(views, 0);
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    result.residuals_px.push_back(RowsFrom(plane, points[i]));
    const double square = result.residuals_px.back() * result.residuals_px.back();
    if (!used[i]) {
      ++result.outliers;
      continue;
    }
    squares[points[i].view] += square;
    n[points[i].view] += 1;
    sum += square;
    ++result.points;
  }
  result.rms_px = std::sqrt(sum / std::max(1, result.points));
  for (std::size_t k = 0; k < views; ++k)
    result.view_rms_px.push_back(std::sqrt(squares[k] / std::max(1.0, n[k])));
}

std::string WhyNarrow(const Spread& spread) {
  const double length = spread.rms_m(2), across = spread.rms_m(1);
  if (across >= kLeastSpread_m && across >= kNarrowest * length) return "";
  return fmt::format(
      "all lines lie within {:.1f} mm of one straight line of space, and every plane through that explains "
      "them: place the board at another height, distance or slant",
      1e3 * across);
}

/// A plane, the points that lie in it, and how these are spread.
struct Consensus {
  Plane plane;
  std::vector<bool> used;
  Spread spread;
};

Consensus Settle(const std::vector<LightPoint>& points, const Plane& first) {
  Consensus found{first, Inliers(points, first, kConsensus_px), {}};
  found.spread = SpreadOf(points, found.used);
  for (const double limit_px : {kConsensus_px, kOutlier_px, kOutlier_px}) {
    found.plane = Refine(points, found.used, found.spread.middle, found.plane);
    found.used = Inliers(points, found.plane, limit_px);
    found.spread = SpreadOf(points, found.used);
  }
  return found;
}

/// Empty if the plane is that of most points, and these are wide enough to fix it.
std::string WhyDoubtful(const Consensus& found) {
  const auto inliers = static_cast<double>(std::count(found.used.begin(), found.used.end(), true));
  const auto all = static_cast<double>(found.used.size());
  if (inliers < kFewestInliers * all)
    return fmt::format(
        "only {:.0f} % of the points lie in one plane: boards or cameras are not where the files place them",
        100 * inliers / all);
  // Judged again: what gave the lines their width may have been another light.
  return WhyNarrow(found.spread);
}

}  // namespace

Outcome<LaserCalibration> CalibrateLaserPlane(std::span<const StripeView> views) {
  const Outcome<std::vector<LightPoint>> points = PointsOf(views);
  if (!points) return Refusal{points.reason()};
  const auto all = SpreadOf(*points, std::vector<bool>(points->size(), true));
  if (std::string reason = WhyNarrow(all); !reason.empty()) return Refusal{reason};
  const std::optional<Plane> first = PlaneOfMost(*points);
  if (!first) return Refusal{"the points of the line coincide"};
  const Consensus found = Settle(*points, *first);
  if (std::string reason = WhyDoubtful(found); !reason.empty()) return Refusal{reason};
  const Plane plane = Refine(*points, found.used, found.spread.middle, found.plane);
  LaserCalibration result;
  const double sign = plane.normal().z() < 0 ? -1 : 1;
  result.plane.normal = sign * plane.normal();
  result.plane.offset_m = sign * plane.offset();
  const Motion motion(result.plane.Plane(), found.spread.middle);
  result.plane.pivot_m = motion.pivot;
  FillErrors(*points, found.used, views.size(), result);
  if (!(result.rms_px < kWorstLight_px))
    return Refusal{fmt::format("the lines are {:.2f} px from where the best plane puts them", result.rms_px)};
  FillSigmas(*points, found.used, views, result.rms_px, motion, result.plane);
  return result;
}

}  // namespace priamos::head
