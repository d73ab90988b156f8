#include "head/core/landmark/pose_solver.hpp"

#include <algorithm>
#include <cmath>

#include "common/principal_axes.hpp"
#include "common/square.hpp"
#include "head/core/landmark/correlated_least_squares.hpp"
#include "head/core/landmark/edge_residual.hpp"
#include "head/core/landmark/left_out.hpp"
#include "head/core/landmark/prediction.hpp"

namespace priamos::head {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// c = L * L.transpose(), also where c is singular.
Matrix6 SquareRoot(const Matrix6& c) {
  const PrincipalAxes<6> ellipsoid = PrincipalAxesOf(c);
  return ellipsoid.axes * ellipsoid.values.cwiseMax(0).cwiseSqrt().asDiagonal();
}

/// Where the errors of an edge begin in ModelErrors.
Eigen::Index ColumnOf(int edge) {
  return Eigen::Index{3} * edge;
}

/// A residual with the error that all cameras share, in standard deviations, and with what it grows by with
/// the errors of the model.
struct Row : EdgeResidual {
  Vector6 by_common = Vector6::Zero();
  Eigen::Vector3d in_model = Eigen::Vector3d::Zero();  ///< EdgeResidual::across, landmark frame
  double by_breadth = 0;  ///< with the breadth of the landmark, whose sides lie half of it beside the middle
};

/// The least squares problem: an edge gives two measurements per image, its distances at two places along it.
class Problem {
 public:
  Problem(const LandmarkModel& model, std::span<const CameraModel* const> cameras,
          std::span<const EdgeObservation> observations, const Eigen::Isometry3d& initial,
          const PoseSolverOptions& options)
      : model_(model),
        cameras_(cameras),
        lines_(ObservedLines(observations)),
        pose_(initial),
        options_(options),
        model_covariance_(options.known ? options.known->covariance
                                        : options.VarianceOfModel().CovarianceFor(model)),
        common_root_(SquareRoot(options.base_covariance)) {
    if (options.on_floor) {
      free_.resize(6, 3);
      free_ << Vector6::Unit(0), Vector6::Unit(1), Vector6::Unit(5);
    } else {
      free_ = Matrix6::Identity();
    }
  }

  PoseSolution Run() {
    PoseSolution solution;
    double previous_step = 1e9;
    for (int i = 0; i < options_.max_iterations; ++i) {
      if (!Linearise()) return solution;
      // Covariance changes little between the iterations; the last step of Finish takes it where it belongs.
      if (i == 0 && !squares_.SetCovariance(CovarianceOfAll())) return solution;
      if (!squares_.Solve(jacobian_, distance_)) return solution;
      pose_ = Moved(pose_, free_ * squares_.step());
      const double size = squares_.step().norm();
      if (!std::isfinite(size) || size > 2) return solution;
      if (size < 1e-6 || (i > 3 && size < 1e-5 && size > 0.5 * previous_step)) break;
      previous_step = size;
    }
    Finish(solution);
    return solution;
  }

 private:
  bool Linearise() {
    residuals_.clear();
    for (const ObservedLine& line : lines_) {
      for (int end = 0; end < line.n; ++end) {
        const LandmarkEdge& edge = model_.edges[line.edge];
        const auto residual = ResidualOf(*cameras_[line.camera], pose_, edge, line.at[end]);
        if (!residual) return false;
        residuals_.push_back({*residual, common_root_.transpose() * residual->by_base.transpose(),
                              pose_.linear().transpose() * residual->across,
                              residual->across.dot(pose_.linear().col(1)) * edge.ByBreadth()});
        residuals_.back().edge = line.edge;
        residuals_.back().camera = line.camera;
        residuals_.back().variance = Square(line.sigma_px) + Square(options_.edge_sigma_px);
      }
    }
    const int n = static_cast<int>(residuals_.size());
    jacobian_.resize(n, free_.cols());
    distance_.resize(n);
    for (int i = 0; i < n; ++i) {
      jacobian_.row(i) = residuals_[i].by_pose * free_;
      distance_[i] = residuals_[i].distance_px;
    }
    return n >= free_.cols();
  }

  /// Covariance of the common errors of two residuals.
  double Covariance(const Row& a, const Row& b) const {
    double c = a.by_common.dot(b.by_common);
    if (a.camera == b.camera) c += Square(options_.camera_sigma_px) * a.by_camera.dot(b.by_camera);
    if (a.edge == b.edge) c += a.across.dot(b.across) * Square(options_.tilt_sigma_m) * a.lever * b.lever;
    return c + CovarianceByModel(a, b);
  }

  /// The part of it that comes from the places of the model's edges.
  double CovarianceByModel(const Row& a, const Row& b) const {
    const Eigen::MatrixXd& known = model_covariance_;
    const Eigen::Index last = known.cols() - 1;
    const double by_breadth = known(last, last) * a.by_breadth * b.by_breadth;
    const LandmarkEdge &edge_a = model_.edges[a.edge], &edge_b = model_.edges[b.edge];
    const bool together = (edge_a.IsLevel() && edge_b.IsLevel()) ||
                          (options_.depth_sigma_m > 0 && AreInOneDepth(edge_a, edge_b));
    if (!options_.known && a.edge != b.edge && !together) return by_breadth;
    return a.in_model.dot(known.block<3, 3>(ColumnOf(a.edge), ColumnOf(b.edge)) * b.in_model) +
           a.in_model.dot(known.block<3, 1>(ColumnOf(a.edge), last)) * b.by_breadth +
           b.in_model.dot(known.block<3, 1>(ColumnOf(b.edge), last)) * a.by_breadth + by_breadth;
  }

  /// Derivative of the residuals by the errors of the model.
  Eigen::MatrixXd ByErrors() const {
    Eigen::MatrixXd by = Eigen::MatrixXd::Zero(distance_.size(), model_covariance_.cols());
    for (std::size_t i = 0; i < residuals_.size(); ++i) {
      const Row& row = residuals_[i];
      const auto at = static_cast<Eigen::Index>(i);
      by.block<1, 3>(at, ColumnOf(row.edge)) = row.in_model.transpose();
      by(at, by.cols() - 1) = row.by_breadth;
    }
    return by;
  }

  /// `matrix` times the covariance of the errors of the model before this look.
  Eigen::MatrixXd TimesPrior(const Eigen::MatrixXd& matrix) const { return matrix * model_covariance_; }

  /// The errors of the model under the condition of the residuals. What only who learns them needs takes
  /// longest.
  void LearnErrors(PoseSolution& solution) const {
    const Eigen::MatrixXd by = ByErrors();
    const Eigen::Index size = by.cols(), last = size - 1;
    const Eigen::VectorXd mean = TimesPrior(squares_.WeightedResiduals().transpose() * by).transpose();
    const Eigen::VectorXd of_breadth = TimesPrior(Eigen::RowVectorXd::Unit(size, last)).transpose();
    const double left = of_breadth(last) - squares_.InformationAbout(by * of_breadth)(0, 0);
    solution.edge_shifts = ShiftsOf(model_, mean);
    solution.breadth = {mean(last), std::sqrt(std::max(left, 0.0))};
    if (!options_.learn) return;
    const Eigen::MatrixXd before = TimesPrior(Eigen::MatrixXd::Identity(size, size));
    solution.errors = {mean, before - squares_.InformationAbout(TimesPrior(by))};
  }

  Eigen::MatrixXd CovarianceOfAll() const {
    const int n = static_cast<int>(residuals_.size());
    Eigen::MatrixXd covariance(n, n);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j <= i; ++j)
        covariance(i, j) = covariance(j, i) = Covariance(residuals_[i], residuals_[j]);
      covariance(i, i) += residuals_[i].variance;
    }
    return covariance;
  }

  void Finish(PoseSolution& solution) {
    if (!Linearise() || !squares_.SetCovariance(CovarianceOfAll())) return;
    if (!squares_.Solve(jacobian_, distance_)) return;
    const Eigen::Index d = free_.cols(), n = distance_.size();
    solution.covariance = free_ * squares_.StepCovariance() * free_.transpose();
    if (!solution.covariance.allFinite()) return;
    solution.own_share = OwnShare();
    solution.chi_squared = squares_.ChiSquared();
    solution.n_redundant = static_cast<int>(n - d);
    solution.misfit = solution.chi_squared / std::max(solution.n_redundant, 1);
    LearnErrors(solution);
    if (options_.find_suspect) solution.suspect = FindSuspect();
    double sum = 0;
    for (const Row& s : residuals_)
      sum += Square(s.distance_px - s.across.dot(pose_.linear() * solution.edge_shifts[s.edge]));
    solution.rms_px = std::sqrt(sum / static_cast<double>(n));
    solution.base_from_landmark = pose_;
    solution.ok = true;
  }

  double OwnShare() const {
    Eigen::VectorXd variance(distance_.size());
    for (std::size_t i = 0; i < residuals_.size(); ++i) variance[i] = residuals_[i].variance;
    return squares_.ShareOf(variance);
  }

  EdgeSuspect FindSuspect() const {
    const LeftOut left_out(squares_);
    EdgeSuspect worst;
    const auto examine = [&](int edge, int camera) {
      std::vector<int> rows;
      for (std::size_t i = 0; i < residuals_.size(); ++i)
        if (residuals_[i].edge == edge && (camera < 0 || residuals_[i].camera == camera))
          rows.push_back(static_cast<int>(i));
      const auto misfit = left_out.Misfit(rows);
      if (misfit && *misfit > worst.misfit) worst = {edge, camera, *misfit};
    };
    for (const ObservedLine& line : lines_) {
      examine(line.edge, line.camera);
      const auto is_same = [&](const ObservedLine& l) { return l.edge == line.edge; };
      const bool first = &line == &*std::find_if(lines_.begin(), lines_.end(), is_same);
      // Of an edge that one image shows, that would be the same residuals once more.
      if (first && std::count_if(lines_.begin(), lines_.end(), is_same) > 1) examine(line.edge, -1);
    }
    return worst;
  }

  const LandmarkModel& model_;
  std::span<const CameraModel* const> cameras_;
  std::vector<ObservedLine> lines_;
  Eigen::Isometry3d pose_;
  PoseSolverOptions options_;
  Eigen::MatrixXd model_covariance_;  ///< of the errors of the model before this look
  Matrix6 common_root_;
  Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 6> free_;  ///< directions in which the pose may move
  std::vector<Row> residuals_;
  Eigen::MatrixXd jacobian_;
  Eigen::VectorXd distance_;
  CorrelatedLeastSquares squares_;
};

}  // namespace

PoseSolution SolvePose(const LandmarkModel& model, std::span<const CameraModel* const> cameras,
                       std::span<const EdgeObservation> observations, const Eigen::Isometry3d& initial,
                       const PoseSolverOptions& options) {
  return Problem(model, cameras, observations, initial, options).Run();
}

}  // namespace priamos::head
