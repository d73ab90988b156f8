#include "planner/core/graph/pose_graph.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::planner {
namespace {

using Eigen::Vector2d;

/// A sight that is off by more sigmas tells little, and the less the more; at first by so many.
constexpr double kRobust = 3, kMostRobust = 100;
/// Keeps what nothing is known of where it is.
constexpr double kDamping = 1e-2;
constexpr double kQuarter_rad = kPi / 2;
/// Sigma of either error of the wheels that stays the same, before anything is known of it.
constexpr double kBias = 0.01;

/// Weight of a residual by Geman and McClure, and what it costs.
double WeightOf(double squares, double robust) {
  const double part = 1 / (1 + squares / (robust * robust));
  return part * part;
}
double RobustCost(double squares, double robust) {
  return squares / (1 + squares / (robust * robust));
}

/// Off a multiple of a quarter turn.
double WrapQuarter(double rad) {
  return std::remainder(rad, kQuarter_rad);
}

/// What a motion is off by in the frame of its beginning, in sigmas.
Eigen::Vector3d ErrorOf(const GraphMotion& motion, const WheelBias& bias, const Pose2& from,
                        const Pose2& to) {
  const Pose2 is = from.Inverse() * to, told = bias.Corrected(motion.from_to);
  const Eigen::Vector3d off(is.x - told.x, is.y - told.y, WrapAngle(is.yaw - told.yaw));
  return off.cwiseQuotient(motion.sigma);
}

/// What a sight is off by: across the line, and by its direction, in sigmas.
Vector2d ErrorOf(const GraphSight& sight, const Pose2& pose, const GraphLine& line) {
  const Vector2d middle = pose * sight.base_from_middle.translation();
  return {line.AcrossTo(middle) / sight.sigma_across_m,
          WrapAngle(line.yaw_rad - pose.yaw - sight.base_from_middle.yaw) / sight.sigma_yaw_rad};
}

}  // namespace

/// The normal equations: information * step = right.
struct PoseGraph::Equations {
  explicit Equations(int size) : right(Eigen::VectorXd::Zero(size)) {}

  /// Adds a residual and its derivatives by some unknowns; what has a negative index is held.
  template <int kRows, int kCols>
  void Add(const Eigen::Matrix<double, kRows, 1>& error, const Eigen::Matrix<double, kRows, kCols>& by,
           const std::array<int, kCols>& at, double weight) {
    const Eigen::Matrix<double, kCols, kCols> information = weight * by.transpose() * by;
    const Eigen::Matrix<double, kCols, 1> gradient = weight * by.transpose() * error;
    for (int i = 0; i < kCols; ++i) {
      if (at[std::size_t(i)] < 0) continue;
      right(at[std::size_t(i)]) -= gradient(i);
      for (int k = 0; k < kCols; ++k)
        if (at[std::size_t(k)] >= 0)
          entries.emplace_back(at[std::size_t(i)], at[std::size_t(k)], information(i, k));
    }
  }

  Eigen::SparseMatrix<double> Information(double damping) const {
    Eigen::SparseMatrix<double> matrix(right.size(), right.size());
    auto all = entries;
    for (int i = 0; i < right.size(); ++i) all.emplace_back(i, i, damping);
    matrix.setFromTriplets(all.begin(), all.end());
    return matrix;
  }

  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right;
};

int PoseGraph::AddPose(const Pose2& map_from_base) {
  poses_.push_back(map_from_base);
  return poses() - 1;
}

int PoseGraph::AddLine(const GraphLine& line) {
  lines_.push_back(line);
  return lines() - 1;
}

void PoseGraph::Join(int kept, int gone) {
  for (GraphSight& sight : sights_)
    if (sight.line == gone) sight.line = kept;
}

void PoseGraph::AddMotions(Equations& equations) const {
  for (const GraphMotion& motion : motions_) {
    const Pose2 &from = pose(motion.from), &to = pose(motion.to);
    const Eigen::Matrix2d back = from.rotation().transpose();
    const Vector2d apart = to.translation() - from.translation();
    Eigen::Matrix<double, 3, 8> by = Eigen::Matrix<double, 3, 8>::Zero();
    by.block<2, 2>(0, 0) = -back;
    by.block<2, 1>(0, 2) = back * Vector2d(apart.y(), -apart.x());
    by.block<2, 2>(0, 3) = back;
    by(2, 2) = -1;
    by(2, 5) = 1;
    by(0, 6) = by(1, 7) = -motion.from_to.x;
    by = motion.sigma.cwiseInverse().asDiagonal() * by;
    const int a = motion.from > 0 ? PoseAt(motion.from) : -3, b = PoseAt(motion.to);
    equations.Add<3, 8>(ErrorOf(motion, bias_, from, to), by,
                        {a, a + 1, a + 2, b, b + 1, b + 2, BiasAt(), BiasAt() + 1}, 1);
  }
  const Vector2d off = Vector2d(bias_.forward, bias_.drift) / kBias;
  equations.Add<2, 2>(off, Eigen::Matrix2d::Identity() / kBias, {BiasAt(), BiasAt() + 1}, 1);
}

void PoseGraph::AddSights(Equations& equations) const {
  for (const GraphSight& sight : sights_) {
    const Pose2& from = pose(sight.pose);
    const GraphLine& at = line(sight.line);
    const Vector2d arm = from.rotation() * sight.base_from_middle.translation();
    const Vector2d middle = from.translation() + arm;
    Eigen::Matrix<double, 2, 5> by;
    by << at.left().x(), at.left().y(), at.left().dot(Vector2d(-arm.y(), arm.x())),
        -at.along().dot(middle - at.anchor), -1,  //
        0, 0, -1, 1, 0;
    by.row(0) /= sight.sigma_across_m;
    by.row(1) /= sight.sigma_yaw_rad;
    const Vector2d error = ErrorOf(sight, from, at);
    const int p = sight.pose > 0 ? PoseAt(sight.pose) : -3, l = LineAt(sight.line);
    equations.Add<2, 5>(error, by, {p, p + 1, p + 2, l, l + 1}, WeightOf(error.squaredNorm(), robust_));
  }
}

void PoseGraph::AddSquare(Equations& equations) const {
  if (!square_) return;
  std::vector<bool> seen(lines_.size());
  for (const GraphSight& sight : sights_) seen[std::size_t(sight.line)] = true;
  for (int i = 0; i < lines(); ++i) {
    if (!seen[std::size_t(i)]) continue;
    const Eigen::Matrix<double, 1, 1> error(WrapQuarter(line(i).yaw_rad - axis_rad_) / square_->sigma_rad);
    const Eigen::Matrix<double, 1, 2> by(1 / square_->sigma_rad, -1 / square_->sigma_rad);
    equations.Add<1, 2>(error, by, {LineAt(i), AxisAt()}, WeightOf(error.squaredNorm(), square_->robust));
  }
}

double PoseGraph::CostOf() const {
  double cost = Vector2d(bias_.forward, bias_.drift).squaredNorm() / (kBias * kBias);
  for (const GraphMotion& motion : motions_)
    cost += ErrorOf(motion, bias_, pose(motion.from), pose(motion.to)).squaredNorm();
  for (const GraphSight& sight : sights_)
    cost += RobustCost(ErrorOf(sight, pose(sight.pose), line(sight.line)).squaredNorm(), robust_);
  if (!square_) return cost;
  std::vector<bool> seen(lines_.size());
  for (const GraphSight& sight : sights_) seen[std::size_t(sight.line)] = true;
  for (int i = 0; i < lines(); ++i)
    if (seen[std::size_t(i)])
      cost += RobustCost(std::pow(WrapQuarter(line(i).yaw_rad - axis_rad_) / square_->sigma_rad, 2),
                         square_->robust);
  return cost;
}

PoseGraph::Equations PoseGraph::Linearise() const {
  Equations equations(size());
  AddMotions(equations);
  AddSights(equations);
  AddSquare(equations);
  return equations;
}

void PoseGraph::Move(const Eigen::VectorXd& by) {
  for (int i = 1; i < poses(); ++i) {
    Pose2& at = poses_[std::size_t(i)];
    const auto step = by.segment<3>(PoseAt(i));
    at = {at.x + step(0), at.y + step(1), WrapAngle(at.yaw + step(2))};
  }
  for (int i = 0; i < lines(); ++i) {
    GraphLine& at = lines_[std::size_t(i)];
    at.yaw_rad = WrapAngle(at.yaw_rad + by(LineAt(i)));
    at.offset_m += by(LineAt(i) + 1);
  }
  axis_rad_ += by(AxisAt());
  bias_.forward += by(BiasAt());
  bias_.drift += by(BiasAt() + 1);
}

/// The direction on which most lines agree, each with the weight of its sights.
void PoseGraph::FindAxis() {
  Vector2d sum(0, 0);
  for (const GraphSight& sight : sights_) {
    const double turned = 4 * line(sight.line).yaw_rad;
    sum += Vector2d(std::cos(turned), std::sin(turned)) / sight.sigma_yaw_rad;
  }
  axis_rad_ = std::atan2(sum.y(), sum.x()) / 4;
}

/// At first all sights are followed, so that those that close a loop pull from afar; what contradicts then,
/// loses its weight step by step (graduated non-convexity: Yang et al. 2020).
void PoseGraph::FollowAll() {
  robust_ = kRobust;
  for (const GraphSight& sight : sights_) robust_ = std::max(robust_, DistanceOf(sight));
  for (robust_ = std::min(robust_, kMostRobust); robust_ > kRobust; robust_ /= 2) Improve(2);
  robust_ = kRobust;
}

double PoseGraph::Adjust() {
  constexpr int kSteps = 8;
  if (square_) FindAxis();
  const double cost = Improve(kSteps);
  auto solver = std::make_shared<Solver>();
  solver->compute(Linearise().Information(kDamping));
  solved_ = solver->info() == Eigen::Success ? solver : nullptr;
  solved_poses_ = poses();
  solved_lines_ = lines();
  return cost;
}

double PoseGraph::Improve(int most_steps) {
  constexpr double kSmall = 1e-4, kMostDamping = 1e6;
  double cost = CostOf(), damping = kDamping;
  Solver solver;
  for (int step = 0; step < most_steps; ++step) {
    const Equations equations = Linearise();
    solver.compute(equations.Information(std::max(damping, kDamping)));
    if (solver.info() != Eigen::Success) break;
    const Eigen::VectorXd by = solver.solve(equations.right);
    const PoseGraph before = *this;
    Move(by);
    const double next = CostOf();
    // Written so that NaN is refused.
    if (!(next <= cost + 1e-9)) {
      *this = before;
      damping = std::max(1.0, damping * 100);
      if (damping > kMostDamping) break;
      continue;
    }
    cost = next;
    damping /= 100;
    if (by.cwiseAbs().maxCoeff() < kSmall) break;
  }
  return cost;
}

double PoseGraph::DistanceOf(const GraphSight& sight) const {
  return ErrorOf(sight, pose(sight.pose), line(sight.line)).norm();
}

std::optional<double> PoseGraph::axis_rad() const {
  return square_ ? std::optional(axis_rad_) : std::nullopt;
}

std::optional<Eigen::MatrixXd> PoseGraph::CovarianceOf(const std::vector<int>& lines) const {
  if (!solved_) return std::nullopt;
  const auto count = static_cast<Eigen::Index>(2 * lines.size());
  const int first = 3 * (solved_poses_ - 1);
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(first + 2 * solved_lines_ + 3, count);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i] >= solved_lines_) return std::nullopt;
    for (int k = 0; k < 2; ++k) columns(first + 2 * lines[i] + k, static_cast<Eigen::Index>(2 * i) + k) = 1;
  }
  const Eigen::MatrixXd solved = solved_->solve(columns);
  Eigen::MatrixXd covariance(count, count);
  for (std::size_t i = 0; i < lines.size(); ++i)
    covariance.middleRows(static_cast<Eigen::Index>(2 * i), 2) = solved.middleRows(first + 2 * lines[i], 2);
  return covariance;
}

}  // namespace priamos::planner
