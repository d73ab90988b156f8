#include "head/core/bodies/contour_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "common/square.hpp"
#include "head/core/bodies/contour_pieces.hpp"
#include "head/core/camera/projection.hpp"
#include "head/core/landmark/edge_residual.hpp"
#include "head/core/landmark/prediction.hpp"

namespace priamos::head {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr double kShortestFitted_px = 6;
constexpr double kUsualPiece_px = 10;  ///< a piece of this length counts as one
constexpr int kFewestFitted = 12;      ///< with which a pose is told
constexpr double kLargestStep = 0.5;   ///< of one iteration [m, rad]
constexpr double kCommonSigma = 0.72;  ///< error of a whole edge, over the distances of its pieces
constexpr double kLeastCommon_px = 0.06, kCommonByBlur = 0.04;
/// How far beside an edge a step counts: falls from iteration to iteration [px].
constexpr double kReaches_px[] = {4.5, 3, 2, 1.5};

/// What one edge in one image says: of errors `d` of its pieces, sums over them.
struct AlongEdge {
  Vector6 shifted = Vector6::Zero(), tilted = Vector6::Zero();  ///< weighted rows; the same by their levers
};

/// Normal equations of the pieces of all edges.
struct Normal {
  Matrix6 information = Matrix6::Zero(), noise = Matrix6::Zero();
  Vector6 right = Vector6::Zero();
  std::vector<AlongEdge> edges;
  double squares = 0, weight = 0;
  int n_pieces = 0;

  void Add(const EdgeResidual& residual, const ContourPiece& piece, double blur_px, double reach_px) {
    const double apart = residual.distance_px / reach_px;
    if (std::abs(apart) >= 1) return;
    const double of_noise = (1 + blur_px) * piece.step.contrast_sigma / piece.step.contrast;
    const double variance = Square(0.1 + 0.1 * blur_px) + Square(of_noise);
    const double weight = Square(1 - Square(apart)) * piece.length_px / kUsualPiece_px / variance;
    const Vector6 row = residual.by_pose.transpose();
    information += weight * row * row.transpose();
    noise += Square(weight * of_noise) * row * row.transpose();
    right += weight * residual.distance_px * row;
    edges.back().shifted += weight * row;
    edges.back().tilted += weight * residual.lever * row;
    squares += weight * Square(residual.distance_px);
    this->weight += weight;
    ++n_pieces;
  }

  /// Errors of the pieces of an edge are alike: what lies beside it moves and turns all of it.
  Matrix6 Covariance(double blur_px) const {
    const double common_px =
        std::hypot(kLeastCommon_px + kCommonByBlur * blur_px, kCommonSigma * std::sqrt(squares / weight));
    Matrix6 of_right = noise;
    for (const AlongEdge& edge : edges)
      of_right += Square(common_px) *
                  (edge.shifted * edge.shifted.transpose() + edge.tilted * edge.tilted.transpose());
    const Matrix6 inverse = information.inverse();
    return inverse * of_right * inverse;
  }
};

Normal Measure(const LandmarkModel& seen, const Eigen::Isometry3d& pose, std::span<const CameraView> views,
               std::span<const StepMeter> meters, double reach_px) {
  Normal normal;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const CameraModel& camera = *views[v].camera;
    const ContourPieces contour(seen, pose, views[v]);
    for (std::size_t i = 0; i < contour.edges().size(); ++i) {
      if (!contour.edges()[i] || contour.edges()[i]->length_px() < kShortestFitted_px) continue;
      normal.edges.emplace_back();
      for (const ContourPiece& piece : contour.Measure(meters[v], i, 0)) {
        if (!piece.IsStep()) continue;
        const Eigen::Vector2d at = camera.Undistort(piece.at + piece.step.shift_px * piece.normal);
        if (const auto residual = ResidualOf(camera, pose, seen.edges[i], at))
          normal.Add(*residual, piece, views[v].blur_px, reach_px);
      }
    }
  }
  return normal;
}

}  // namespace

std::optional<ContourPose> FitContour(const Polyhedron& body, const Eigen::Isometry3d& start,
                                      std::span<const CameraView> views, std::span<const StepMeter> meters) {
  ContourPose fit;
  fit.base_from_model = start;
  double blur_px = 0;
  for (const CameraView& view : views) blur_px = std::max(blur_px, view.blur_px);
  int i = 0;
  for (const double reach_px : kReaches_px) {
    if (i++ % 2 == 0)
      fit.seen = VisibleSkeleton(body, fit.base_from_model.inverse() * OpticalCentre(*views[0].camera));
    const Normal normal = Measure(fit.seen, fit.base_from_model, views, meters, reach_px);
    if (normal.n_pieces < kFewestFitted) return std::nullopt;
    const Vector6 step = normal.information.ldlt().solve(normal.right);
    if (!step.allFinite() || step.norm() > kLargestStep) return std::nullopt;
    fit.base_from_model = Moved(fit.base_from_model, step);
    fit.covariance = normal.Covariance(blur_px);
  }
  if (!fit.covariance.allFinite()) return std::nullopt;
  return fit;
}

}  // namespace priamos::head
