#include "head/core/pose_solver.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "head/core/prediction.hpp"

namespace priamos::head {
namespace {

constexpr double kNearDepth = 0.1;
/// Unknowns: the pose; the error that all cameras share; of every camera a shift, a roll and a scale; of
/// every edge a shift and a tilt, across it. The points of one edge in one image know all but the common
/// error directly; that one acts like a change of the pose.
constexpr int kPose = 6, kCommon = 6, kCamera = 4, kEdge = 4;
constexpr int kLocal = kPose + kCamera + kEdge, kAll = kLocal + kCommon;
constexpr double kCameraLeverPx = 300;  ///< roll and scale are counted in pixels that far from the centre
using VectorN = Eigen::Matrix<double, kLocal, 1>;
using MatrixN = Eigen::Matrix<double, kLocal, kLocal>;
using Vector6 = Eigen::Matrix<double, kPose, 1>;
using Matrix6 = Eigen::Matrix<double, kPose, kPose>;

double Square(double x) {
  return x * x;
}

/// c = L * L.transpose(), also where c is singular.
Matrix6 SquareRoot(const Matrix6& c) {
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(c);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

/// What a small motion about the origin of base is as a motion about the origin of the landmark, axes kept.
Matrix6 AboutLandmark(const Eigen::Vector3d& landmark_in_base) {
  const Eigen::Vector3d& o = landmark_in_base;
  Matrix6 m = Matrix6::Identity();
  m.topRightCorner<3, 3>() << 0, o.z(), -o.y(), -o.z(), 0, o.x(), o.y(), -o.x(), 0;
  return m;
}

/// The points of one model edge in one image.
struct Group {
  int edge = 0, camera = 0;
  std::span<const EdgeObservation> points;
  double weight = 1;
  double mean_px = 0;
};

std::vector<Group> MakeGroups(std::span<const EdgeObservation> observations) {
  std::vector<Group> groups;
  for (std::size_t begin = 0; begin < observations.size();) {
    std::size_t end = begin + 1;
    while (end < observations.size() && observations[end].edge == observations[begin].edge &&
           observations[end].camera == observations[begin].camera) {
      ++end;
    }
    groups.push_back(
        {observations[begin].edge, observations[begin].camera, observations.subspan(begin, end - begin)});
    begin = end;
  }
  return groups;
}

/// The whole model edge in the image, uncut: points may lie a little beyond its ends.
std::optional<PredictedEdge> Project(const CameraModel& camera, const Eigen::Vector3d& from,
                                     const Eigen::Vector3d& to) {
  PredictedEdge edge;
  edge.in_base_p = from, edge.in_base_q = to;
  edge.depth_p = camera.Depth(from), edge.depth_q = camera.Depth(to);
  if (edge.depth_p < kNearDepth && edge.depth_q < kNearDepth) return std::nullopt;
  if (edge.depth_p < kNearDepth || edge.depth_q < kNearDepth) {
    const double cut = (kNearDepth - edge.depth_p) / (edge.depth_q - edge.depth_p);
    (edge.depth_p < kNearDepth ? edge.in_base_p : edge.in_base_q) = from + cut * (to - from);
    (edge.depth_p < kNearDepth ? edge.depth_p : edge.depth_q) = kNearDepth;
  }
  edge.p = camera.Project(edge.in_base_p), edge.q = camera.Project(edge.in_base_q);
  if (edge.length_px() < 1) return std::nullopt;
  return edge;
}

class Problem {
 public:
  Problem(const LandmarkModel& model, std::span<const CameraModel* const> cameras,
          std::span<const EdgeObservation> observations, const Eigen::Isometry3d& initial,
          const PoseSolverOptions& options)
      : model_(model),
        cameras_(cameras),
        groups_(MakeGroups(observations)),
        pose_(initial),
        options_(options),
        common_root_(SquareRoot(options.base_covariance)) {
    slot_of_edge_.assign(model.edges.size(), -1);
    for (const Group& g : groups_) {
      if (slot_of_edge_[g.edge] < 0) slot_of_edge_[g.edge] = n_edges_++;
    }
    first_edge_ = kFirstCamera + kCamera * static_cast<int>(cameras.size());
    size_ = first_edge_ + kEdge * n_edges_;
  }

  PoseSolution Run() {
    PoseSolution solution;
    double previous_step = 1e9;
    for (int i = 0; i < options_.max_iterations; ++i) {
      Linearise();
      if (!Reweight(i)) return solution;
      Assemble();
      const Eigen::LDLT<Eigen::MatrixXd> ldlt(normal_);
      if (ldlt.info() != Eigen::Success || ldlt.rcond() < 1e-14) return solution;
      const Eigen::VectorXd step = ldlt.solve(right_);
      Apply(step);
      const double size = step.head<3>().norm() + step.segment<3>(3).norm();
      if (!std::isfinite(size) || size > 2) return solution;
      if (size < 1e-6 || (i > 3 && size < 1e-5 && size > 0.5 * previous_step)) break;
      previous_step = size;
    }
    Finish(solution);
    return solution;
  }

 private:
  static constexpr int kFirstCamera = kPose + kCommon;

  struct Rows {
    MatrixN normal = MatrixN::Zero();
    VectorN right = VectorN::Zero();
    double mean = 0;
    VectorN mean_jacobian = VectorN::Zero();
    bool ok = false;
  };

  void Linearise() {
    rows_.assign(groups_.size(), Rows{});
    for (std::size_t i = 0; i < groups_.size(); ++i) LineariseGroup(groups_[i], rows_[i]);
  }

  void LineariseGroup(Group& group, Rows& rows) const {
    const LandmarkEdge& edge = model_.edges[group.edge];
    const CameraModel& camera = *cameras_[group.camera];
    const Eigen::Vector3d from = pose_ * edge.from;
    const auto view = Project(camera, from, pose_ * edge.to);
    if (!view) return;
    // Two axes across the edge in which the model may be wrong.
    const double length = (edge.to - edge.from).norm();
    const Eigen::Vector3d along = pose_.linear() * (edge.to - edge.from) / length;
    const Eigen::Vector3d axis1 = along.unitOrthogonal(), axis2 = along.cross(axis1);
    const Eigen::Vector2d normal = view->normal();
    double weight_sum = 0;
    for (const EdgeObservation& o : group.points) {
      const Eigen::Vector3d point = view->PointAt(o.at);
      if (camera.Depth(point) < kNearDepth) continue;
      const Eigen::RowVector3d in_space = normal.transpose() * ProjectionJacobian(camera, point);
      VectorN j;
      j.head<6>() = (in_space * PoseJacobian(pose_, point)).transpose();
      const Eigen::Vector2d arm = (o.at - camera.centre_px) / kCameraLeverPx;
      j.segment<kCamera>(kPose) << normal, normal.dot(Eigen::Vector2d(-arm.y(), arm.x())), normal.dot(arm);
      const double lever = 2 * along.dot(point - from) / length - 1;  // -1 at one end, 1 at the other
      const Eigen::Vector2d across(in_space.dot(axis1), in_space.dot(axis2));
      j.segment<kEdge>(kPose + kCamera) << across, lever * across;
      const double residual = normal.dot(o.at - view->p), weight = 1 / (o.sigma_px * o.sigma_px);
      rows.normal.noalias() += weight * j * j.transpose();
      rows.right += weight * residual * j;
      rows.mean += weight * residual, rows.mean_jacobian += weight * j, weight_sum += weight;
    }
    if (weight_sum <= 0) return;
    rows.mean /= weight_sum, rows.mean_jacobian /= weight_sum;
    rows.ok = true;
  }

  bool Reweight(int iteration) {
    int n = 0;
    // The first steps come from afar: nobody is an outlier yet.
    const double limit = options_.outlier_px * (iteration == 0 ? 4 : iteration == 1 ? 2 : 1);
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      const double excess = std::abs(rows_[i].mean) / limit;
      groups_[i].mean_px = rows_[i].mean;
      groups_[i].weight = !rows_[i].ok ? 0 : excess > 1 ? 1 / (excess * excess) : 1;
      n += rows_[i].ok;
    }
    return n >= (options_.on_floor ? 3 : 6);
  }

  /// Common error, in standard deviations, to pose.
  Matrix6 PoseFromCommon() const { return AboutLandmark(pose_.translation()) * common_root_; }

  /// Where the unknowns of a group stand among all: local ones, then the common error.
  std::array<int, kAll> Places(const Group& group) const {
    std::array<int, kAll> at;
    for (int k = 0; k < kPose; ++k) at[k] = k;
    for (int k = 0; k < kCamera; ++k) at[kPose + k] = kFirstCamera + kCamera * group.camera + k;
    for (int k = 0; k < kEdge; ++k)
      at[kPose + kCamera + k] = first_edge_ + kEdge * slot_of_edge_[group.edge] + k;
    for (int k = 0; k < kCommon; ++k) at[kLocal + k] = kPose + k;
    return at;
  }

  void Assemble() {
    normal_ = Eigen::MatrixXd::Zero(size_, size_);
    right_ = Eigen::VectorXd::Zero(size_);
    Eigen::Matrix<double, kLocal, kAll> local_from_all = Eigen::Matrix<double, kLocal, kAll>::Zero();
    local_from_all.leftCols<kLocal>().setIdentity();
    local_from_all.topRightCorner<kPose, kCommon>() = PoseFromCommon();
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      if (!rows_[i].ok) continue;
      const std::array<int, kAll> at = Places(groups_[i]);
      const Eigen::Matrix<double, kAll, 1> right = local_from_all.transpose() * rows_[i].right;
      const Eigen::Matrix<double, kAll, kAll> normal =
          local_from_all.transpose() * rows_[i].normal * local_from_all;
      for (int r = 0; r < kAll; ++r) {
        right_[at[r]] += groups_[i].weight * right[r];
        for (int c = 0; c < kAll; ++c) normal_(at[r], at[c]) += groups_[i].weight * normal(r, c);
      }
    }
    AddPriors();
  }

  /// Model errors and camera shifts are linear and small, so they are not carried from step to step: each
  /// step estimates them anew around zero.
  void AddPriors() {
    for (int k = kPose; k < size_; ++k) normal_(k, k) += 1 / Square(PriorSigma(k));
    if (!options_.on_floor) return;
    for (int k = 2; k < 5; ++k) {
      normal_.row(k).setZero(), normal_.col(k).setZero();
      normal_(k, k) = 1, right_[k] = 0;
    }
  }

  double PriorSigma(int k) const {
    if (k < kFirstCamera) return 1;
    if (k < first_edge_) return options_.camera_sigma_px;
    return (k - first_edge_) % kEdge < 2 ? options_.model_sigma_m : options_.tilt_sigma_m;
  }

  void Apply(const Eigen::VectorXd& step) {
    const Eigen::Vector3d turn = step.segment<3>(3);
    pose_.translation() += step.head<3>();
    if (turn.norm() > 0) {
      pose_.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * pose_.linear();
    }
  }

  void Finish(PoseSolution& solution) {
    Linearise();
    if (!Reweight(options_.max_iterations)) return;
    Assemble();
    const Eigen::MatrixXd inverse = normal_.inverse();
    if (!inverse.allFinite()) return;
    solution.covariance = inverse.topLeftCorner<6, 6>();
    if (options_.on_floor) {
      for (int k = 2; k < 5; ++k) solution.covariance.row(k).setZero(), solution.covariance.col(k).setZero();
    }
    double sum = 0;
    int n = 0;
    for (const Group& g : groups_) {
      if (g.weight <= 0) continue;
      sum += g.mean_px * g.mean_px, ++n;
      solution.worst_px = std::max(solution.worst_px, std::abs(g.mean_px));
    }
    solution.rms_px = std::sqrt(sum / std::max(n, 1));
    AddMisfit(inverse * right_, solution);
    solution.base_from_landmark = pose_;
    solution.ok = true;
  }

  /// The priors and the rest after them, evaluated where the last step leads.
  void AddMisfit(const Eigen::VectorXd& step, PoseSolution& solution) const {
    constexpr double kUnexplainedPx = 0.15;  // of a whole edge, after all that is modelled
    const Vector6 common = step.segment<kCommon>(kPose);
    const Vector6 pose_by_common = PoseFromCommon() * common;
    solution.edge_misfit.assign(model_.edges.size(), 0);
    double sum = common.squaredNorm() + step.segment(kFirstCamera, first_edge_ - kFirstCamera).squaredNorm() /
                                            Square(options_.camera_sigma_px);
    int n = 0;
    for (std::size_t e = 0; e < model_.edges.size(); ++e) {
      if (slot_of_edge_[e] < 0) continue;
      const int first = first_edge_ + kEdge * slot_of_edge_[e];
      for (int k = first; k < first + kEdge; ++k) {
        solution.edge_misfit[e] += Square(step[k] / PriorSigma(k));
      }
    }
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      if (!rows_[i].ok) continue;
      const VectorN& j = rows_[i].mean_jacobian;
      const auto shift = step.segment<kCamera>(kFirstCamera + kCamera * groups_[i].camera);
      const auto edge = step.segment<kEdge>(first_edge_ + kEdge * slot_of_edge_[groups_[i].edge]);
      const double rest = rows_[i].mean - j.head<kPose>().dot(pose_by_common) -
                          j.segment<kCamera>(kPose).dot(shift) - j.tail<kEdge>().dot(edge);
      solution.edge_misfit[groups_[i].edge] += Square(rest / kUnexplainedPx);
      ++n;
    }
    for (const double m : solution.edge_misfit) sum += m;
    solution.misfit = sum / std::max(n - (options_.on_floor ? 3 : 6), 1);
  }

  const LandmarkModel& model_;
  std::span<const CameraModel* const> cameras_;
  std::vector<Group> groups_;
  Eigen::Isometry3d pose_;
  PoseSolverOptions options_;
  Matrix6 common_root_;
  std::vector<int> slot_of_edge_;
  int n_edges_ = 0, first_edge_ = 0, size_ = 0;
  std::vector<Rows> rows_;
  Eigen::MatrixXd normal_;
  Eigen::VectorXd right_;
};

}  // namespace

PoseSolution SolvePose(const LandmarkModel& model, std::span<const CameraModel* const> cameras,
                       std::span<const EdgeObservation> observations, const Eigen::Isometry3d& initial,
                       const PoseSolverOptions& options) {
  return Problem(model, cameras, observations, initial, options).Run();
}

}  // namespace priamos::head
