#include "planner/core/graph/pose_graph.hpp"

#include <algorithm>
#include <cmath>

#include "planner/core/graph/graph_equations.hpp"

namespace priamos::planner {
namespace {

using Eigen::Vector2d;

/// A sight that is off by more sigmas tells little, and the less the more; at first by so many.
constexpr double kRobust = 3, kMostRobust = 100;
/// Keeps what nothing is known of where it is.
constexpr double kDamping = 1e-2;

}  // namespace

int PoseGraph::AddPose(const Pose2& map_from_base) {
  poses_.push_back(map_from_base);
  return poses() - 1;
}

int PoseGraph::AddLine(const GraphLine& line) {
  lines_.push_back(line);
  return lines() - 1;
}

int PoseGraph::AddPoint(const Vector2d& at) {
  points_.push_back(at);
  return points() - 1;
}

void PoseGraph::JoinPoints(int kept, int gone) {
  for (GraphPointSight& sight : point_sights_)
    if (sight.point == gone) sight.point = kept;
}

void PoseGraph::Join(int kept, int gone) {
  for (GraphSight& sight : sights_)
    if (sight.line == gone) sight.line = kept;
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
  for (int i = 0; i < points(); ++i) points_[std::size_t(i)] += by.segment<2>(PointAt(i));
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
  for (const GraphPointSight& sight : point_sights_) robust_ = std::max(robust_, DistanceOf(sight));
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
  solved_points_ = points();
  return cost;
}

double PoseGraph::Improve(int most_steps) {
  constexpr double kSmall = 1e-4, kMostDamping = 1e6;
  double cost = CostOf(), damping = kDamping;
  Solver solver;
  for (int step = 0; step < most_steps; ++step) {
    const GraphEquations equations = Linearise();
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

std::optional<double> PoseGraph::axis_rad() const {
  return square_ ? std::optional(axis_rad_) : std::nullopt;
}

/// Where the two unknowns of a node were in the last adjustment; nullopt: it was added since.
std::optional<int> PoseGraph::SolvedAt(const GraphNode& node) const {
  const int first_line = 3 * (solved_poses_ - 1), first_point = first_line + 2 * solved_lines_;
  if (node.kind == GraphNode::Kind::kLine)
    return node.index < solved_lines_ ? std::optional(first_line + 2 * node.index) : std::nullopt;
  return node.index < solved_points_ ? std::optional(first_point + 2 * node.index) : std::nullopt;
}

std::optional<Eigen::MatrixXd> PoseGraph::CovarianceOf(const std::vector<GraphNode>& nodes) const {
  if (!solved_) return std::nullopt;
  const auto count = static_cast<Eigen::Index>(2 * nodes.size());
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(solved_->rows(), count);
  std::vector<int> at;
  for (const GraphNode& node : nodes) {
    const auto solved_at = SolvedAt(node);
    if (!solved_at) return std::nullopt;
    for (int k = 0; k < 2; ++k) columns(*solved_at + k, static_cast<Eigen::Index>(2 * at.size()) + k) = 1;
    at.push_back(*solved_at);
  }
  const Eigen::MatrixXd solved = solved_->solve(columns);
  Eigen::MatrixXd covariance(count, count);
  for (std::size_t i = 0; i < at.size(); ++i)
    covariance.middleRows(static_cast<Eigen::Index>(2 * i), 2) = solved.middleRows(at[i], 2);
  return covariance;
}

}  // namespace priamos::planner
