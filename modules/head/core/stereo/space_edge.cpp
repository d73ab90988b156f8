#include "head/core/stereo/space_edge.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "head/core/camera/projection.hpp"

namespace priamos::head {
namespace {

using Matrix34 = Eigen::Matrix<double, 3, 4>;

/// A line of space by two points.
struct TwoPoints {
  Eigen::Vector3d a, b;
};

/// The plane through the optical centre that crosses the image line at `at`: where it cuts the edge, the edge
/// is seen there.
Eigen::Vector4d CrossPlane(const CameraModel& camera, const ViewLine& line, const Eigen::Vector2d& at) {
  const Eigen::Vector2d along = (line.q - line.p) / line.length_px;
  return camera.image_from_base.transpose() * Eigen::Vector3d(along.x(), along.y(), -along.dot(at));
}

/// Where the planes of sight of the two sightings with the largest angle between them meet.
std::optional<TwoPoints> Intersect(std::span<const LineSighting> sightings) {
  double best = 1e-4;
  std::optional<TwoPoints> line;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    for (std::size_t j = i + 1; j < sightings.size(); ++j) {
      const Eigen::Vector4d p = sightings[i].view->lines[sightings[i].line].plane,
                            q = sightings[j].view->lines[sightings[j].line].plane;
      const Eigen::Vector3d direction = p.head<3>().cross(q.head<3>());
      if (direction.norm() < best) continue;
      best = direction.norm();
      Eigen::Matrix3d m;
      m << p.head<3>().transpose(), q.head<3>().transpose(), direction.transpose() / best;
      const Eigen::Vector3d origin = OpticalCentre(*sightings[i].view->camera);
      const Eigen::Vector3d right(-p.w(), -q.w(), direction.dot(origin) / best);
      const Eigen::Vector3d point = m.inverse() * right;
      line = TwoPoints{point, point + direction / best};
    }
  }
  return line;
}

/// The part of the line that all images show, from -> to in the direction of the first image.
std::optional<TwoPoints> CommonPart(std::span<const LineSighting> sightings, const TwoPoints& line) {
  const Eigen::Vector3d delta = line.b - line.a;
  double low = -1e9, high = 1e9;
  bool reversed = false;
  for (const LineSighting& sighting : sightings) {
    const ViewLine& seen = sighting.view->lines[sighting.line];
    double t[2];
    for (int end = 0; end < 2; ++end) {
      const Eigen::Vector4d plane = CrossPlane(*sighting.view->camera, seen, end == 0 ? seen.p : seen.q);
      const double slope = plane.head<3>().dot(delta);
      if (std::abs(slope) < 1e-9) return std::nullopt;
      t[end] = -plane.dot(line.a.homogeneous()) / slope;
    }
    if (&sighting == &sightings.front()) reversed = t[0] > t[1];
    low = std::max(low, std::min(t[0], t[1]));
    high = std::min(high, std::max(t[0], t[1]));
  }
  if (low >= high) return std::nullopt;
  TwoPoints part{line.a + low * delta, line.a + high * delta};
  if (reversed) std::swap(part.a, part.b);
  for (const LineSighting& sighting : sightings) {
    if (MetricDepth(*sighting.view->camera, part.a) < 0.1 ||
        MetricDepth(*sighting.view->camera, part.b) < 0.1)
      return std::nullopt;
  }
  return part;
}

/// Normal equations of the edge's four degrees of freedom: both points across it.
class EdgeProblem {
 public:
  EdgeProblem(std::span<const LineSighting> sightings, const TwoPoints& line, double camera_sigma_px)
      : line_(line) {
    const Eigen::Vector3d along = (line.b - line.a).normalized();
    across_.col(0) = along.unitOrthogonal();
    across_.col(1) = along.cross(across_.col(0));
    for (const LineSighting& sighting : sightings) Add(sighting, camera_sigma_px);
  }

  bool Solve(TwoPoints& line) {
    const Eigen::LDLT<Eigen::Matrix4d> ldlt(normal_);
    if (ldlt.info() != Eigen::Success || ldlt.rcond() < 1e-12) return false;
    const Eigen::Vector4d step = ldlt.solve(right_);
    line.a = line_.a + across_ * step.head<2>();
    line.b = line_.b + across_ * step.tail<2>();
    chi2_ = squares_ - right_.dot(step);
    return step.allFinite();
  }
  Eigen::Matrix<double, 6, 6> Covariance() const {
    Eigen::Matrix<double, 6, 4> spread = Eigen::Matrix<double, 6, 4>::Zero();
    spread.topLeftCorner<3, 2>() = across_;
    spread.bottomRightCorner<3, 2>() = across_;
    return spread * normal_.inverse() * spread.transpose();
  }
  double chi2() const { return std::max(0.0, chi2_); }

 private:
  /// A fitted line is worth two points at sigma_normal / sigma_angle from its centre: their errors are
  /// uncorrelated, sqrt(2) * sigma_normal each.
  void Add(const LineSighting& sighting, double camera_sigma_px) {
    const ViewLine& seen = sighting.view->lines[sighting.line];
    const EdgeSegment& segment = sighting.view->edges->segments[seen.segment];
    const CameraModel& camera = *sighting.view->camera;
    const Eigen::Vector2d a = camera.Project(line_.a), b = camera.Project(line_.b);
    const Eigen::Vector2d delta = b - a;
    const double length = delta.norm();
    const Eigen::Vector2d normal(-delta.y() / length, delta.x() / length);
    const Eigen::RowVector2d at_a = normal.transpose() * ProjectionJacobian(camera, line_.a) * across_;
    const Eigen::RowVector2d at_b = normal.transpose() * ProjectionJacobian(camera, line_.b) * across_;
    const Eigen::Vector2d along = (seen.q - seen.p) / seen.length_px;
    const Eigen::Vector2d centre = seen.p + along.dot(segment.centre - seen.p) * along;
    const double arm = std::min(segment.sigma_normal_px / segment.sigma_angle_rad, seen.length_px);
    const double variance =
        2 * (segment.sigma_normal_px * segment.sigma_normal_px + camera_sigma_px * camera_sigma_px);
    for (const double side : {-1.0, 1.0}) {
      const Eigen::Vector2d point = centre + side * arm * along;
      const double s = delta.dot(point - a) / (length * length);
      Eigen::Vector4d jacobian;
      jacobian << (1 - s) * at_a.transpose(), s * at_b.transpose();
      const double residual = normal.dot(point - a);
      normal_ += jacobian * jacobian.transpose() / variance;
      right_ += jacobian * residual / variance;
      squares_ += residual * residual / variance;
    }
  }

  TwoPoints line_;
  Eigen::Matrix<double, 3, 2> across_;
  Eigen::Matrix4d normal_ = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right_ = Eigen::Vector4d::Zero();
  double squares_ = 0, chi2_ = 0;
};

}  // namespace

std::optional<SpaceEdge> Reconstruct(std::span<const LineSighting> sightings, double camera_sigma_px) {
  const auto line = Intersect(sightings);
  if (!line) return std::nullopt;
  auto part = CommonPart(sightings, *line);
  if (!part) return std::nullopt;
  // Two images determine the edge exactly; with more, two steps balance their errors.
  for (int round = 0; round < (sightings.size() > 2 ? 2 : 1); ++round) {
    EdgeProblem problem(sightings, *part, camera_sigma_px);
    if (!problem.Solve(*part)) return std::nullopt;
  }
  part = CommonPart(sightings, *part);
  if (!part) return std::nullopt;
  EdgeProblem problem(sightings, *part, camera_sigma_px);
  TwoPoints unused = *part;
  if (!problem.Solve(unused)) return std::nullopt;
  return SpaceEdge{part->a, part->b, problem.Covariance(), problem.chi2()};
}

Eigen::Vector3d Epipole(const CameraModel& in, const CameraModel& of) {
  return in.image_from_base * OpticalCentre(of).homogeneous();
}

double EpipolarAngle(const ViewLine& line, const Eigen::Vector3d& epipole) {
  const Eigen::Vector2d middle = (line.p + line.q) / 2;
  const Eigen::Vector2d to_epipole = epipole.head<2>() - epipole.z() * middle;
  return std::asin(std::min(1.0, std::abs(line.normal.dot(to_epipole)) / to_epipole.norm()));
}

double MetricDepth(const CameraModel& camera, const Eigen::Vector3d& in_base) {
  return camera.Depth(in_base) / camera.image_from_base.row(2).head<3>().norm();
}

}  // namespace priamos::head
