#include "head/core/drift/stereo_drift.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "head/core/landmark/prediction.hpp"
#include "head/core/stereo/view_line.hpp"

namespace priamos::head {
namespace {

using Eigen::MatrixXd;
using Eigen::RowVector3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Unknowns: pose, turn, scale of each camera, then of every edge a shift and a tilt across it.
constexpr int kPose = 6, kTurn = 3, kScales = 2, kEdge = 4;
constexpr int kFirstTurn = kPose, kFirstScale = kPose + kTurn, kFirstEdge = kFirstScale + kScales;
constexpr double kLever_px = 300;  // scale and roll are counted in pixels that far from the centre
// The landmark stands on the floor about as upright as the robot; loose, so that a turn is not hidden in it.
constexpr double kLift_m = 0.01, kLean_rad = 0.01, kFree = 10;
constexpr std::size_t kFewestPoints = 4;
constexpr int kPasses = 4;
constexpr double kNearDepth = 0.1;

/// The mean of half of an edge's points in one image.
struct HalfEdge {
  int edge, camera;
  Vector2d at;
  double sigma_px;
};

/// Rows of x right, y down, z forward in the base frame.
Eigen::Matrix3d Axes(const CameraModel& camera) {
  const Vector3d forward = camera.image_from_base.block<1, 3>(2, 0).transpose().normalized();
  const Vector3d u = camera.image_from_base.block<1, 3>(0, 0);
  const Vector3d right = (u - u.dot(forward) * forward).normalized();
  return (Eigen::Matrix3d() << right.transpose(), forward.cross(right).transpose(), forward.transpose())
      .finished();
}

/// Halves each edge of each image along its direction.
std::vector<HalfEdge> Halves(std::span<const EdgeObservation> observations, double floor_px) {
  std::map<std::array<int, 2>, std::vector<const EdgeObservation*>> groups;
  for (const EdgeObservation& o : observations) groups[{o.edge, o.camera}].push_back(&o);
  std::vector<HalfEdge> halves;
  for (auto& [key, points] : groups) {
    if (points.size() < kFewestPoints) continue;
    const Vector2d span = points.back()->at - points.front()->at;
    std::stable_sort(points.begin(), points.end(),
                     [&](const auto* a, const auto* b) { return span.dot(a->at) < span.dot(b->at); });
    const std::size_t middle = points.size() / 2;
    for (const auto& [begin, end] : {std::pair(std::size_t{0}, middle), std::pair(middle, points.size())}) {
      HalfEdge half{key[0], key[1], Vector2d::Zero(), 0};
      const auto n = static_cast<double>(end - begin);
      for (std::size_t i = begin; i < end; ++i) {
        half.at += points[i]->at / n;
        half.sigma_px += points[i]->sigma_px * points[i]->sigma_px / (n * n);
      }
      half.sigma_px = std::sqrt(half.sigma_px + floor_px * floor_px);
      halves.push_back(half);
    }
  }
  return halves;
}

class DriftProblem {
 public:
  DriftProblem(const LandmarkModel& model, const CameraModel& left, const CameraModel& right,
               const Eigen::Isometry3d& pose, const StereoDriftOptions& options)
      : model_(model), cameras_{&left, &right}, pose_(pose), options_(options), axes_(Axes(right)) {}

  std::optional<StereoDrift> Solve(const std::vector<HalfEdge>& halves) {
    for (const HalfEdge& half : halves) slots_.try_emplace(half.edge, static_cast<int>(slots_.size()));
    for (const HalfEdge& half : halves) Linearise(half);
    const auto size = static_cast<Eigen::Index>(kFirstEdge + kEdge * slots_.size());
    VectorXd x = VectorXd::Zero(size);
    MatrixXd covariance;
    for (int pass = 0; pass < kPasses; ++pass) {
      MatrixXd normal = Prior().asDiagonal();
      VectorXd rhs = VectorXd::Zero(size);
      for (const Row& row : rows_) {
        const double excess = std::abs(row.residual - row.jacobian.dot(x)) / options_.outlier_px;
        const double weight = (excess > 1 && pass > 0 ? 1 / (excess * excess) : 1) * row.weight;
        normal += weight * row.jacobian * row.jacobian.transpose();
        rhs += weight * row.residual * row.jacobian;
      }
      covariance = normal.inverse();
      x = covariance * rhs;
    }
    StereoDrift drift{x.segment<kTurn>(kFirstTurn), covariance.block<kTurn, kTurn>(kFirstTurn, kFirstTurn)};
    drift.covariance.diagonal() += Floor();
    const bool determined =
        x.allFinite() && drift.covariance.allFinite() && drift.covariance.diagonal().maxCoeff() < 1e-2;
    return determined ? std::optional(drift) : std::nullopt;
  }

 private:
  struct Row {
    VectorXd jacobian;
    double residual, weight;
  };

  /// Inverse variances.
  VectorXd Prior() const {
    VectorXd prior(kFirstEdge + kEdge * slots_.size());
    const double scale = 1 / (options_.calibration_sigma_px * options_.calibration_sigma_px);
    prior.head<kPose>() << 1 / kFree, 1 / kFree, 1 / (kLift_m * kLift_m), 1 / (kLean_rad * kLean_rad),
        1 / (kLean_rad * kLean_rad), 1 / kFree;
    prior.segment<kTurn>(kFirstTurn).setConstant(1 / kFree);
    prior.segment<kScales>(kFirstScale).setConstant(scale);
    for (int i = kFirstEdge; i < prior.size(); ++i) {
      const double sigma = (i - kFirstEdge) % kEdge < 2 ? options_.model_sigma_m : options_.tilt_sigma_m;
      prior(i) = 1 / (sigma * sigma);
    }
    return prior;
  }

  /// Variances of the apparent turn of cameras that did not move: errors of the calibration.
  Vector3d Floor() const {
    const double shift = options_.calibration_sigma_px / FocalLength(*cameras_[1]);
    const double roll = options_.calibration_sigma_px / kLever_px;
    return 2 * Vector3d(shift * shift, shift * shift, roll * roll);
  }

  void Linearise(const HalfEdge& half) {
    const LandmarkEdge& edge = model_.edges[half.edge];
    const CameraModel& camera = *cameras_[half.camera];
    const Vector3d from = pose_ * edge.from, to = pose_ * edge.to;
    ProjectedEdge line;
    line.in_base_p = from;
    line.in_base_q = to;
    line.depth_p = camera.Depth(from);
    line.depth_q = camera.Depth(to);
    if (!(line.depth_p > kNearDepth && line.depth_q > kNearDepth)) return;
    line.p = camera.Project(from);
    line.q = camera.Project(to);
    const Vector3d point = line.PointAt(half.at);
    const RowVector3d in_space = line.normal().transpose() * ProjectionJacobian(camera, point);
    Row row;
    row.jacobian = VectorXd::Zero(kFirstEdge + kEdge * slots_.size());
    row.jacobian.head<kPose>() = (in_space * PoseJacobian(pose_, point)).transpose();
    if (half.camera == 1) row.jacobian.segment<kTurn>(kFirstTurn) = TurnDerivative(camera, in_space, point);
    row.jacobian(kFirstScale + half.camera) = line.normal().dot(half.at - camera.centre_px) / kLever_px;
    AddEdge(half, from, to, point, in_space, row.jacobian);
    row.residual = line.normal().dot(half.at - line.p);
    row.weight = 1 / (half.sigma_px * half.sigma_px);
    rows_.push_back(std::move(row));
  }

  /// A camera that turns by w sees what a camera that stays sees of a world that turns by -w.
  Vector3d TurnDerivative(const CameraModel& camera, const RowVector3d& in_space,
                          const Vector3d& point) const {
    const Vector3d arm = point - OpticalCentre(camera);
    Vector3d derivative;
    for (int i = 0; i < kTurn; ++i) derivative(i) = -in_space.dot(Vector3d(axes_.row(i)).cross(arm));
    return derivative;
  }

  void AddEdge(const HalfEdge& half, const Vector3d& from, const Vector3d& to, const Vector3d& point,
               const RowVector3d& in_space, VectorXd& jacobian) const {
    const double length = (to - from).norm();
    const Vector3d along = (to - from) / length, axis1 = along.unitOrthogonal(), axis2 = along.cross(axis1);
    const double lever = 2 * along.dot(point - from) / length - 1;  // -1 at one end, 1 at the other
    const Vector2d across(in_space.dot(axis1), in_space.dot(axis2));
    jacobian.segment<kEdge>(kFirstEdge + kEdge * slots_.at(half.edge)) << across, lever * across;
  }

  const LandmarkModel& model_;
  std::array<const CameraModel*, 2> cameras_;
  const Eigen::Isometry3d& pose_;
  const StereoDriftOptions& options_;
  Eigen::Matrix3d axes_;  ///< axes of the right camera
  std::map<int, int> slots_;
  std::vector<Row> rows_;
};

int EdgesInBoth(const std::vector<HalfEdge>& halves) {
  std::map<int, int> seen;
  for (const HalfEdge& half : halves) seen[half.edge] |= 1 << half.camera;
  return static_cast<int>(
      std::count_if(seen.begin(), seen.end(), [](const auto& s) { return s.second == 3; }));
}

}  // namespace

double FocalLength(const CameraModel& camera) {
  const double scale = camera.image_from_base.block<1, 3>(2, 0).norm();
  return camera.image_from_base.block<1, 3>(0, 0).cross(camera.image_from_base.block<1, 3>(2, 0)).norm() /
         (scale * scale);
}

std::optional<StereoDrift> MeasureDrift(const LandmarkModel& model,
                                        std::span<const EdgeObservation> observations,
                                        const CameraModel& left, const CameraModel& right,
                                        const Eigen::Isometry3d& base_from_landmark,
                                        const StereoDriftOptions& options) {
  std::vector<HalfEdge> halves = Halves(observations, options.edge_sigma_px);
  std::erase_if(halves, [&model](const HalfEdge& half) { return model.edges[half.edge].IsMovable(); });
  if (EdgesInBoth(halves) < options.min_edges) return std::nullopt;
  return DriftProblem(model, left, right, base_from_landmark, options).Solve(halves);
}

}  // namespace priamos::head
