#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/time.hpp"
#include "planner/core/map/seen_feature.hpp"

namespace priamos::planner {

/// A piece of wall as the sonars showed it, in the frame of the way: from its middle half its length forwards
/// and backwards, with the base to the left.
struct HeardPiece {
  Pose2 way_from_middle;
  double length_m = 0;
  Eigen::Vector2d heard_from{0, 0};  ///< where the base was when it was heard last, frame of the way
  double at_m = 0;                   ///< how far the base had driven by then

  Eigen::Vector2d At(double along_m) const { return way_from_middle * Eigen::Vector2d(along_m, 0); }
  /// Its point nearest to a place.
  Eigen::Vector2d NearestTo(const Eigen::Vector2d& place) const;
};

/// What is known of a drive without knowing where on the plan it was.
struct DrivenWay {
  std::vector<HeardPiece> pieces;
  std::vector<Pose2> trail;  ///< way_from_base at places where the base was, in order; the last one is now
  double driven_m = 0;

  const Pose2& base() const { return trail.back(); }
};

/// Collects the way that a robot drives and the walls that it reports, in a frame that moves with no
/// correction: the robot's own map frame as it was at the beginning, continued where its pose is set or
/// corrected. Walls that were heard last before the beginning, or before the newest correction, are left out:
/// in which frame they were told is not known.
class WayLog {
 public:
  /// Forgets everything; what is heard from now on counts.
  void Begin(Time now);
  /// The newest pose, map frame of the robot; `corrected`: when its pose was set or corrected last, if it
  /// was.
  void OnPose(Time stamp, const Pose2& told_from_base, std::optional<Time> corrected);
  /// A feature that it reported: walls count.
  void OnFeature(const SeenFeature& seen);

  bool empty() const { return spots_.empty(); }
  /// Pieces on one line that overlap are one. Of an empty log there is no way.
  DrivenWay way() const;
  const Pose2& way_from_told() const { return way_from_told_; }
  const Pose2& way_from_base() const { return way_from_base_; }
  double driven_m() const { return driven_m_; }
  /// Counts the changes of the pieces.
  std::size_t revision() const { return revision_; }

 private:
  struct Spot {
    Time stamp{};
    Pose2 way_from_base;
    double at_m = 0;
  };
  const Spot& SpotAt(double utc_s) const;

  std::vector<Spot> spots_;
  Pose2 way_from_told_, way_from_base_;
  Time newest_{};
  std::optional<Time> corrected_;
  double not_before_s_ = 0;
  double driven_m_ = 0;
  std::map<FeatureName, HeardPiece> pieces_;
  std::size_t revision_ = 0;
};

}  // namespace priamos::planner
