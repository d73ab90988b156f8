#include <cmath>

#include "planner/core/graph/graph_equations.hpp"
#include "planner/core/graph/pose_graph.hpp"

/// What ties poses, lines and points together, and what it costs.
namespace priamos::planner {
namespace {

using Eigen::Vector2d;

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

/// What a sight of a place is off by along x and y of the map, in sigmas.
Vector2d ErrorOf(const GraphPointSight& sight, const Pose2& pose, const Vector2d& point) {
  return (pose * sight.base_from_point - point) / sight.sigma_m;
}

}  // namespace

void PoseGraph::AddMotions(GraphEquations& equations) const {
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

void PoseGraph::AddSights(GraphEquations& equations) const {
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

void PoseGraph::AddPointSights(GraphEquations& equations) const {
  for (const GraphPointSight& sight : point_sights_) {
    const Pose2& from = pose(sight.pose);
    const Vector2d arm = from.rotation() * sight.base_from_point;
    Eigen::Matrix<double, 2, 5> by;
    by << 1, 0, -arm.y(), -1, 0,  //
        0, 1, arm.x(), 0, -1;
    by /= sight.sigma_m;
    const Vector2d error = ErrorOf(sight, from, point(sight.point));
    const int p = sight.pose > 0 ? PoseAt(sight.pose) : -3, l = PointAt(sight.point);
    equations.Add<2, 5>(error, by, {p, p + 1, p + 2, l, l + 1}, WeightOf(error.squaredNorm(), robust_));
  }
}

void PoseGraph::AddSquare(GraphEquations& equations) const {
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
  for (const GraphPointSight& sight : point_sights_)
    cost += RobustCost(std::pow(DistanceOf(sight), 2), robust_);
  if (!square_) return cost;
  std::vector<bool> seen(lines_.size());
  for (const GraphSight& sight : sights_) seen[std::size_t(sight.line)] = true;
  for (int i = 0; i < lines(); ++i)
    if (seen[std::size_t(i)])
      cost += RobustCost(std::pow(WrapQuarter(line(i).yaw_rad - axis_rad_) / square_->sigma_rad, 2),
                         square_->robust);
  return cost;
}

GraphEquations PoseGraph::Linearise() const {
  GraphEquations equations(size());
  AddMotions(equations);
  AddSights(equations);
  AddPointSights(equations);
  AddSquare(equations);
  return equations;
}

double PoseGraph::DistanceOf(const GraphSight& sight) const {
  return ErrorOf(sight, pose(sight.pose), line(sight.line)).norm();
}

double PoseGraph::DistanceOf(const GraphPointSight& sight) const {
  return ErrorOf(sight, pose(sight.pose), point(sight.point)).norm();
}

}  // namespace priamos::planner
