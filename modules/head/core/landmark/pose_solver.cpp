#include "head/core/landmark/pose_solver.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "head/core/landmark/edge_residual.hpp"

namespace priamos::head {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

double Square(double x) {
  return x * x;
}

/// c = L * L.transpose(), also where c is singular.
Matrix6 SquareRoot(const Matrix6& c) {
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(c);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

/// A residual with the error that all cameras share, in standard deviations.
struct Row : EdgeResidual {
  Vector6 by_common = Vector6::Zero();
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
      if (i == 0 && !Whiten()) return solution;
      Eigen::VectorXd step;
      if (!Solve(step)) return solution;
      Apply(free_ * step);
      const double size = step.norm();
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
        residuals_.push_back({*residual, common_root_.transpose() * residual->by_base.transpose()});
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
    if (a.edge == b.edge) {
      const double shift_m =
          model_.edges[a.edge].IsMovable() ? options_.movable_sigma_m : options_.model_sigma_m;
      c += a.across.dot(b.across) * (Square(shift_m) + Square(options_.tilt_sigma_m) * a.lever * b.lever);
    }
    return c;
  }

  bool Whiten() {
    const int n = static_cast<int>(residuals_.size());
    Eigen::MatrixXd covariance(n, n);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j <= i; ++j)
        covariance(i, j) = covariance(j, i) = Covariance(residuals_[i], residuals_[j]);
      covariance(i, i) += residuals_[i].variance;
    }
    whitening_.compute(covariance);
    return whitening_.info() == Eigen::Success;
  }

  /// Least squares step of the free directions.
  bool Solve(Eigen::VectorXd& step) {
    white_jacobian_ = jacobian_;
    white_distance_ = distance_;
    whitening_.matrixL().solveInPlace(white_jacobian_);
    whitening_.matrixL().solveInPlace(white_distance_);
    information_.compute(white_jacobian_.transpose() * white_jacobian_);
    if (information_.info() != Eigen::Success || information_.rcond() < 1e-12) return false;
    step = information_.solve(white_jacobian_.transpose() * white_distance_);
    return true;
  }

  void Apply(const Vector6& step) {
    const Eigen::Vector3d turn = step.tail<3>();
    pose_.translation() += step.head<3>();
    if (turn.norm() > 0) {
      pose_.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * pose_.linear();
    }
  }

  void Finish(PoseSolution& solution) {
    Eigen::VectorXd step;
    if (!Linearise() || !Whiten() || !Solve(step)) return;
    const Eigen::Index d = free_.cols(), n = distance_.size();
    solution.covariance = free_ * information_.solve(Eigen::MatrixXd::Identity(d, d)) * free_.transpose();
    if (!solution.covariance.allFinite()) return;
    solution.own_share = OwnShare();
    const double chi_squared = (white_distance_ - white_jacobian_ * step).squaredNorm();
    solution.misfit = chi_squared / static_cast<double>(std::max<Eigen::Index>(n - d, 1));
    if (options_.find_suspect) solution.suspect = FindSuspect();
    double sum = 0;
    for (const Row& s : residuals_) sum += Square(s.distance_px);
    solution.rms_px = std::sqrt(sum / static_cast<double>(n));
    solution.base_from_landmark = pose_;
    solution.ok = true;
  }

  /// The estimate moves by P J' V^-1 times the errors of the distances. So a part C of their covariance V
  /// makes P (A' C A) P of P, where A = V^-1 J: as a share of it trace(A' C A P) / d, and all parts
  /// together 1.
  double OwnShare() const {
    const Eigen::Index d = free_.cols();
    const Eigen::MatrixXd a = whitening_.matrixU().solve(white_jacobian_);
    const Eigen::MatrixXd weighted = information_.solve(a.transpose());
    double share = 0;
    for (Eigen::Index i = 0; i < a.rows(); ++i)
      share += residuals_[i].variance * a.row(i).dot(weighted.col(i)) / static_cast<double>(d);
    return share;
  }

  /// Leaving some of the residuals out takes r' (P_ss)^-1 r from chi squared, where P projects out what the
  /// pose explains and r = P * distances: exact, and without solving anew.
  EdgeSuspect FindSuspect() {
    const Eigen::Index n = distance_.size();
    const Eigen::MatrixXd inverse = whitening_.solve(Eigen::MatrixXd::Identity(n, n));
    const Eigen::MatrixXd to_pose = inverse * jacobian_;
    const Eigen::MatrixXd projector = inverse - to_pose * information_.solve(to_pose.transpose());
    const Eigen::VectorXd rest = projector * distance_;
    EdgeSuspect worst;
    const auto examine = [&](int edge, int camera) {
      std::vector<int> rows;
      for (int i = 0; i < n; ++i)
        if (residuals_[i].edge == edge && (camera < 0 || residuals_[i].camera == camera)) rows.push_back(i);
      const Eigen::MatrixXd block = projector(rows, rows);
      const Eigen::LDLT<Eigen::MatrixXd> ldlt(block);
      if (ldlt.rcond() < 1e-9) return;  // without it there would be no pose
      const Eigen::VectorXd own = rest(rows);
      const double misfit = own.dot(ldlt.solve(own)) / static_cast<double>(rows.size());
      if (misfit > worst.misfit) worst = {edge, camera, misfit};
    };
    for (const ObservedLine& line : lines_) {
      examine(line.edge, line.camera);
      const bool first = &line == &*std::find_if(lines_.begin(), lines_.end(),
                                                 [&](const ObservedLine& l) { return l.edge == line.edge; });
      if (first) examine(line.edge, -1);
    }
    return worst;
  }

  const LandmarkModel& model_;
  std::span<const CameraModel* const> cameras_;
  std::vector<ObservedLine> lines_;
  Eigen::Isometry3d pose_;
  PoseSolverOptions options_;
  Matrix6 common_root_;
  Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 6> free_;  ///< directions in which the pose may move
  std::vector<Row> residuals_;
  Eigen::MatrixXd jacobian_, white_jacobian_;
  Eigen::VectorXd distance_, white_distance_;
  Eigen::LLT<Eigen::MatrixXd> whitening_;
  Eigen::LDLT<Eigen::MatrixXd> information_;
};

}  // namespace

PoseSolution SolvePose(const LandmarkModel& model, std::span<const CameraModel* const> cameras,
                       std::span<const EdgeObservation> observations, const Eigen::Isometry3d& initial,
                       const PoseSolverOptions& options) {
  return Problem(model, cameras, observations, initial, options).Run();
}

}  // namespace priamos::head
