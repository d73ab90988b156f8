#pragma once

#include <array>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "common/archive.hpp"
#include "common/time.hpp"
#include "robot/core/base/footprint.hpp"
#include "robot/core/sonar/line_votes.hpp"
#include "robot/core/sonar/sonar_cycle.hpp"
#include "robot/core/sonar/waiting_echoes.hpp"
#include "robot/core/sonar/wall_segment.hpp"

namespace priamos::robot {

/// Which echoes count, and for how long.
struct SegmentFinderConfig {
  double window_m = 3;      ///< an echo is forgotten after the base has driven so far ...
  double window_s = 30;     ///< ... or after this time
  double moved_m = 0.02;    ///< a sensor that has not moved so far ...
  double turned_deg = 1.5;  ///< ... or turned so much tells nothing new
  int votes = 12;           ///< echoes on one line that are looked at closely
  double least_m = 0.6;     ///< length of a new segment
  double surplus = 9;       ///< a point explains its echoes so much worse, see PointOverLine()
  double gap_m = 0.35;      ///< echoes farther apart are not of one wall
  double keep_m = 6;        ///< a segment grows no more after the base has driven so far without hearing it
  int groups = 3;           ///< sensors i, i + groups, ... fire together, one group after the other ...
  double cycle_s = 0.1;     ///< ... within a cycle
  WallSegmentConfig segment{};

  void Describe(Archive& a);
};

/// A segment, and when it was heard last.
struct FoundSegment {
  int number = 0;  ///< from 1; stays when the segment grows
  Time heard{};
  WallSegment wall;
};

/// Finds straight walls from all echoes of the moving ring. Echoes that no known wall explains vote for
/// lines; where enough agree, those that lie together are fitted, and what is surely straight (FitWall) is a
/// wall. From then on it grows by every echo that fits it.
class SegmentFinder {
 public:
  SegmentFinder(const SegmentFinderConfig& config, const OdometryNoise& noise, const Footprint& footprint);

  /// Whether an echo can be one of a corner or an edge that is known.
  using OfPoint = std::function<bool(const PlacedEcho&)>;
  /// Adds a cycle of the ring. `odom_from_base`: pose at its end. Returns the segments that changed. What can
  /// be of a point makes no wall longer: the edges of an opening lie on the line of the wall beside it.
  std::vector<const FoundSegment*> Add(const SonarCycle& cycle, const Pose2& odom_from_base,
                                       const OfPoint& of_point = {});
  /// The segments that still may grow, oldest first.
  const std::deque<FoundSegment>& segments() const { return segments_; }
  /// The echoes of the last cycle that tell anything new.
  const std::vector<PlacedEcho>& heard() const { return heard_; }
  /// Those of them that no segment takes.
  const std::vector<PlacedEcho>& unexplained() const { return unexplained_; }
  /// How far the base has driven [m].
  double travel_m() const { return travel_m_; }

 private:
  std::vector<PlacedEcho> NewEchoes(const SonarCycle& cycle, const Pose2& odom_from_base);
  Pose2 BaseWhenFired(std::size_t sensor, const SonarCycle& cycle, const Pose2& odom_from_base) const;
  std::vector<PlacedEcho> Explain(std::vector<PlacedEcho> echoes, Time time, const OfPoint& of_point,
                                  std::vector<const FoundSegment*>& changed);
  void Forget(Time now);
  const FoundSegment* Begin(const PlacedEcho& echo, Time time);
  std::vector<PlacedEcho> Supporters(const VotedLine& line, const PlacedEcho& newest) const;
  bool IsRatherALine(const std::vector<PlacedEcho>& echoes, double angle_rad) const;

  SegmentFinderConfig config_;
  OdometryNoise noise_;
  std::array<Pose2, kSonars> base_from_sonar_;
  std::array<Pose2, kSonars> taken_at_;  ///< where each sensor was when it told something new
  std::array<bool, kSonars> taken_{};
  Pose2 last_base_;
  std::optional<Time> last_cycle_;
  double travel_m_ = 0;
  WaitingEchoes<LineVotes> waiting_;  ///< for a wall that explains them
  std::vector<PlacedEcho> heard_, unexplained_;
  std::deque<FoundSegment> segments_;
  int last_number_ = 0;
};

}  // namespace priamos::robot
