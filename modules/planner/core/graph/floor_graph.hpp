#pragma once

#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "common/archive.hpp"
#include "common/learned/learned_walls.hpp"
#include "planner/core/graph/pose_graph.hpp"
#include "planner/core/graph/wall_spans.hpp"
#include "planner/core/map/seen_feature.hpp"

namespace priamos::planner {

/// What the wheels and a wall that was told are believed to err, and when two walls are one.
struct FloorGraphConfig {
  double key_m = 0.5;      ///< a pose becomes part of the graph after so much driving ...
  double key_deg = 20;     ///< ... or turning
  double walk_m = 0.01;    ///< sigma of the place after a metre of driving
  double turn_deg = 0.4;   ///< sigma of the heading after a metre of driving, and after turning by a radian
  double least_m = 0.8;    ///< a shorter piece of wall ties nothing together
  double across_m = 0.02;  ///< sigma of a piece's middle across it
  double yaw_deg = 0.4;    ///< sigma of its direction, and ...
  double edge_m = 0.01;    ///< ... the place of its ends, which makes short ones turn
  bool square = true;      ///< walls are expected to be parallel or perpendicular, when most of them are
  SquarePrior prior;
  double square_share = 0.7;  ///< of the walls' length; less, and nothing is expected
  double gate = 3;            ///< Mahalanobis distance of two walls up to which they may be one
  double apart = 5;           ///< as far is every other wall that could be meant
  double alone_m = 0.2;       ///< three sigmas of the distance; known worse, other walls have to agree
  bool points = true;         ///< corners and edges that are met again tie poses together as walls do
  double point_m = 0.02;      ///< least sigma of a point in either direction

  void Describe(Archive& a);
};

/// A place that moves with the map when that is adjusted.
struct GraphAnchor {
  int key = 0;
  Pose2 key_from_place;
};

/// The map that a robot makes of an unknown floor while it drives by its own reckoning. What it tells (poses,
/// walls) is in its own frame, which drifts; the graph ties the walls to the poses from which they were
/// heard, joins those that are one, and adjusts all. A wall that is met again is joined only when it lies
/// where it was to be expected, no other could be meant, and, unless the place is known well, others that
/// are met again agree. Points (corners and edges) are joined likewise: they alone tell where along a
/// corridor the robot is.
class FloorGraph {
 public:
  explicit FloorGraph(const FloorGraphConfig& config) : config_(config) {}

  void Reset();
  /// The robot is here, by its own frame, at a time [s]. The first pose is the frame of the map.
  void NoteAt(const Pose2& robot_frame_from_base, double at_s);
  /// A wall as the robot tells it, in its own frame; or a corner or an edge.
  /// Nothing changes before the first pose.
  void Note(const SeenFeature& seen);
  /// Joins walls that are one, and adjusts everything. Returns whether anything came since the last time.
  bool Settle();

  /// Whether no pose was noted yet.
  bool empty() const { return keys_.empty(); }
  /// The robot's frame in the map, as it is now (MAP_TO_ODOM of the design).
  Pose2 map_from_robot() const;
  /// All walls and points that were told, where they lie by now.
  LearnedWalls Walls() const;
  /// A place given in the map as it is now, and where it is later.
  GraphAnchor AnchorOf(const Pose2& map_from_place) const;
  Pose2 PlaceOf(const GraphAnchor& anchor) const;

  int loops() const { return loops_; }      ///< walls and points that were met again and joined
  int refused() const { return refused_; }  ///< and those that did not agree with the rest when they were
  const PoseGraph& graph() const { return graph_; }
  bool is_square() const { return graph_.axis_rad().has_value(); }

 private:
  struct Key {
    double at_s = 0;
    Pose2 robot_frame_from_base;
  };
  struct Told {
    int key = 0, line = -1;  ///< no line: too short
    Pose2 key_from_middle;
    LearnedWall wall;
  };
  struct ToldPoint {
    GraphPointSight sight;
    LearnedPoint point;
    Eigen::Vector2d towards{1, 0};  ///< from the base that found it to it, frame of the pose
  };
  /// Two lines, or two points, that may be one.
  struct Candidate {
    GraphNode kept, gone;
    Eigen::Vector2d error{0, 0};
    Eigen::Matrix<double, 2, 4> by = Eigen::Matrix<double, 2, 4>::Zero();
    double sigma_m = 0, distance = 0;
  };

  void NoteWall(const FeatureName& name, const LearnedWall& wall);
  void NotePoint(const SeenFeature& seen, const LearnedPoint& point);
  int KeyAt(double at_s) const;
  void AddKey(const Pose2& at, double at_s);
  GraphSight SightOf(const Told& told) const;
  bool IsOnLine(const Told& told) const;
  void TestSquare();
  bool JoinOnce();
  bool JoinTogether(const std::vector<Candidate>& found);
  bool Agree(const Candidate& a, const Candidate& b) const;
  std::vector<Candidate> Candidates() const;
  static std::optional<double> Meet(const GraphLine& a, const std::vector<WallSpan>& own, const GraphLine& b,
                                    const std::vector<WallSpan>& others);
  std::optional<Candidate> CandidateAt(int kept, int gone, double at_m) const;
  void AddPointCandidates(const std::map<int, std::vector<WallSpan>>& spans,
                          std::vector<Candidate>& found) const;
  std::optional<Candidate> PointCandidate(int kept, int gone) const;
  static bool IsAmbiguous(const Candidate& candidate, const std::vector<Candidate>& all);
  bool IsAmbiguousPoint(const Candidate& candidate, const std::set<int>& tied) const;
  /// What two nodes that are one differ by besides the graph's own errors, sigma of either unknown.
  static Eigen::Vector2d UnevenOf(const GraphNode& node);
  bool AreOnOneSide(const Candidate& candidate, const std::map<int, std::vector<WallSpan>>& spans) const;
  bool AreHeardTogether(int one, int other) const;
  std::vector<Eigen::Vector2d> FoundTowards(int point) const;
  bool IsKnownWell(const Candidate& candidate) const;
  std::set<int> TiedPoints() const;
  bool Join(const std::vector<Candidate>& pairs);
  void Rename(const GraphNode& kept, const GraphNode& gone);
  std::map<int, std::vector<WallSpan>> Spans() const;

  FloorGraphConfig config_;
  PoseGraph graph_;
  std::vector<Key> keys_;
  Key newest_;
  double driven_m_ = 0, turned_rad_ = 0;  ///< since the newest key
  std::map<FeatureName, Told> told_;
  std::map<FeatureName, ToldPoint> points_;
  std::set<std::pair<GraphNode, GraphNode>> apart_;  ///< that are not one
  bool changed_ = false;
  int loops_ = 0, refused_ = 0;
};

}  // namespace priamos::planner
