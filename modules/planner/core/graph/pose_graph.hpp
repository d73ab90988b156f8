#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <compare>
#include <memory>
#include <optional>
#include <vector>

#include "common/geometry.hpp"

namespace priamos::planner {

/// A line on the floor, map frame: its direction, and how far to the left of the anchor it lies there.
struct GraphLine {
  Eigen::Vector2d anchor{0, 0};
  double yaw_rad = 0;
  double offset_m = 0;

  Eigen::Vector2d along() const { return {std::cos(yaw_rad), std::sin(yaw_rad)}; }
  Eigen::Vector2d left() const { return {-std::sin(yaw_rad), std::cos(yaw_rad)}; }
  /// How far to the left of the line a place lies [m].
  double AcrossTo(const Eigen::Vector2d& place) const { return left().dot(place - anchor) - offset_m; }
  double AlongTo(const Eigen::Vector2d& place) const { return along().dot(place - anchor); }
  Eigen::Vector2d At(double along_m) const { return anchor + along_m * along() + offset_m * left(); }
};

/// The base moved from one pose to another; sigmas of x, y [m] and yaw [rad].
struct GraphMotion {
  int from = 0, to = 0;
  Pose2 from_to;
  Eigen::Vector3d sigma{0.01, 0.01, 0.01};
};

/// A piece of a line as it was heard from a pose: its middle and direction in the frame of the base.
struct GraphSight {
  int pose = 0, line = 0;
  Pose2 base_from_middle;
  double sigma_across_m = 0.02, sigma_yaw_rad = 0.01;
};

/// A point, a corner or an edge, as it was heard from a pose: its place in the frame of the base, and the
/// sigma of that in any direction.
struct GraphPointSight {
  int pose = 0, point = 0;
  Eigen::Vector2d base_from_point{0, 0};
  double sigma_m = 0.04;
};

/// A line or a point of the graph; each has two unknowns: direction and offset, or x and y.
struct GraphNode {
  /// What a node stands for.
  enum class Kind { kLine, kPoint };
  Kind kind = Kind::kLine;
  int index = 0;

  auto operator<=>(const GraphNode&) const = default;
};

struct GraphEquations;

/// Errors of the wheels that stay the same: radii and rollers do not change on the way.
struct WheelBias {
  double forward = 0;  ///< of the distance driven forward
  double drift = 0;    ///< sideways per metre forward, to the left

  Pose2 Corrected(const Pose2& told) const {
    return {told.x * (1 + forward), told.y + told.x * drift, told.yaw};
  }
};

/// How lines are expected to stand to each other in a building.
struct SquarePrior {
  double sigma_rad = Radians(0.5);  ///< a wall is turned so much against the building's axes
  double robust = 2;  ///< one that is off by so many sigmas and more stands as it stands, and tells nothing
};

/// Poses, lines and points, and what ties them together, adjusted to agree best: Gauss's and Newton's least
/// squares on the sparse normal equations (Dellaert and Kaess 2006), damped (Levenberg and Marquardt). The
/// first pose stays where it is. A sight that contradicts the others loses its weight (Geman and McClure's
/// function).
class PoseGraph {
 public:
  /// They are numbered from 0 in the order in which they are added.
  int AddPose(const Pose2& map_from_base);
  int AddLine(const GraphLine& line);
  int AddPoint(const Eigen::Vector2d& at);
  void Add(const GraphMotion& motion) { motions_.push_back(motion); }
  void Add(const GraphSight& sight) { sights_.push_back(sight); }
  void Add(const GraphPointSight& sight) { point_sights_.push_back(sight); }
  /// All sights of `gone` are of `kept` from now on.
  void Join(int kept, int gone);
  void JoinPoints(int kept, int gone);
  /// Whether walls are taken to be parallel or perpendicular to each other; none: they are not.
  void SetSquare(const std::optional<SquarePrior>& prior) { square_ = prior; }

  /// Adjusts all; returns the sum of the weighted squares afterwards.
  double Adjust();
  /// To be called before it when something new may contradict what was adjusted so far by much: a loop.
  void FollowAll();
  /// What the sum is as all lies now.
  double CostOf() const;

  const Pose2& pose(int index) const { return poses_[std::size_t(index)]; }
  const GraphLine& line(int index) const { return lines_[std::size_t(index)]; }
  const Eigen::Vector2d& point(int index) const { return points_[std::size_t(index)]; }
  int poses() const { return static_cast<int>(poses_.size()); }
  int lines() const { return static_cast<int>(lines_.size()); }
  int points() const { return static_cast<int>(points_.size()); }
  const std::vector<GraphSight>& sights() const { return sights_; }
  /// How many sigmas a sight is off, by place and by direction together.
  double DistanceOf(const GraphSight& sight) const;
  double DistanceOf(const GraphPointSight& sight) const;
  const WheelBias& bias() const { return bias_; }
  /// Direction of the building's axes, of which one is meant; none: no prior is set.
  std::optional<double> axis_rad() const;

  /// Covariance of the unknowns of several nodes, as of the last adjustment; nullopt: one of them was added
  /// since.
  std::optional<Eigen::MatrixXd> CovarianceOf(const std::vector<GraphNode>& nodes) const;

 private:
  using Solver = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;
  GraphEquations Linearise() const;
  void AddMotions(GraphEquations& equations) const;
  void AddSights(GraphEquations& equations) const;
  void AddPointSights(GraphEquations& equations) const;
  void AddSquare(GraphEquations& equations) const;
  std::optional<int> SolvedAt(const GraphNode& node) const;
  double Improve(int most_steps);
  void Move(const Eigen::VectorXd& by);
  void FindAxis();
  int PoseAt(int pose) const { return 3 * (pose - 1); }
  int LineAt(int line) const { return 3 * (poses() - 1) + 2 * line; }
  int PointAt(int point) const { return LineAt(lines()) + 2 * point; }
  int AxisAt() const { return PointAt(points()); }
  int BiasAt() const { return AxisAt() + 1; }
  int size() const { return BiasAt() + 2; }

  std::vector<Pose2> poses_;
  std::vector<GraphLine> lines_;
  std::vector<Eigen::Vector2d> points_;
  std::vector<GraphMotion> motions_;
  std::vector<GraphSight> sights_;
  std::vector<GraphPointSight> point_sights_;
  std::optional<SquarePrior> square_;
  double axis_rad_ = 0;
  WheelBias bias_;
  double robust_ = 3;                     ///< a sight that is off by more sigmas loses its weight
  std::shared_ptr<const Solver> solved_;  ///< of the last adjustment
  int solved_poses_ = 0, solved_lines_ = 0, solved_points_ = 0;
};

}  // namespace priamos::planner
