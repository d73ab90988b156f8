#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/time.hpp"
#include "robot/core/base/footprint.hpp"
#include "robot/core/motion/back_off.hpp"
#include "robot/core/motion/detour.hpp"
#include "robot/core/motion/path_shape.hpp"

namespace priamos::robot {

/// Gains and limits of following a path, and when the goal counts as reached.
struct PathFollowerConfig {
  PathShapeConfig shape;
  DetourConfig detour;
  double gain_per_s = 1.5;              ///< velocity towards the path per distance from it
  double turn_gain_per_s = 2.0;         ///< turn rate per heading error
  double correction_speed_m_s = 0.15;   ///< fastest velocity towards the path
  double correction_turn_rad_s = 0.25;  ///< fastest turn towards the heading
  double arrival_m = 0.005;
  double arrival_deg = 0.2;
  double latency_s = 0.06;        ///< from a pose to wheels that obey it
  double aside_speed_m_s = 0.25;  ///< fastest velocity towards a detour
  double aside_m = 0.15;          ///< this far from its detour the base does not go ahead

  void Describe(Archive& a);
};

/// Drives the base along a path at continuous speed: the position on the path comes from the pose alone, so
/// a corrected pose moves the reference along the path and leaves a cross-track error, which is driven back
/// at a limited rate while the distance along the path goes on. Brakes for corners as far as they need it and
/// for the last point. Gives a wanted velocity; limits on its change are TwistSlew's.
class PathFollower {
 public:
  /// The velocity wanted at one tick, and where the base is on its path.
  struct Wanted {
    Twist2 twist;  ///< base frame
    double remaining_m = 0;
    double cross_track_m = 0;      ///< positive when left of the path
    double heading_error_rad = 0;  ///< how far the heading is to be turned, counter-clockwise
    bool arrived = false;
  };

  /// `footprint`: of the base that has to fit between things.
  explicit PathFollower(const PathFollowerConfig& config, const Footprint& footprint = {})
      : config_(config), footprint_(footprint) {}

  /// Takes a path; replaces the one before. It begins at `pose`, or beside it on its own first line when the
  /// first point has just been passed.
  void Follow(const Path& path, const Pose2& pose);
  /// Lays the path that is being driven anew, beside the base: `start` is there, on the new one. Where it is
  /// left around things it still is.
  void Realign(const Path& path, const Pose2& start);
  /// Looks, a few times per second, for a way around `things` (map frame [m]) within the leeway of the path,
  /// and goes by it. A way that was found stays until there is a better one. Where none leads on and the base
  /// has stood for a while it goes back over what it has just driven, to where another one branches off.
  void Avoid(std::span<const Eigen::Vector2d> things, Time now);
  /// Tells that the base stands for somebody who comes, and not before what closes its way.
  void Waits() { stands_.reset(); }
  /// Whether Avoid will look now, so that it needs to be told what is there.
  bool LooksAround(Time now) const {
    return shape_ && (seeks_ || !searched_ || now - *searched_ >= FromSeconds(config_.detour.replan_s));
  }
  /// Changes the fastest speeds, also on the path that is being driven.
  void LimitSpeeds(const PathShapeConfig& limits);
  /// Drops the path; Step then returns a velocity of 0.
  void Drop();
  bool has_path() const { return shape_.has_value(); }
  /// Whether the base is on its way back out of a dead end.
  bool BacksOff() const { return shape_ && back_off_; }
  /// How far the line that is being driven may be left; not at all without a path.
  Leeway LeewayHere() const { return shape_ ? shape_->LeewayAt(s_) : Leeway{}; }
  /// Distance left from beside `pose` to the end of the path, which is being driven.
  double RemainingFrom(const Pose2& pose) const {
    return shape_->RemainingDistance(shape_->Project(pose, s_));
  }

  /// Length [m] left of the path that is being driven, its turns included.
  double LengthLeft() const { return shape_->length() - s_; }
  /// A slow motion of a base at `pose` along the path that is being driven, without any way around things,
  /// base frame.
  Twist2 Onward(const Pose2& pose) const;

  /// Computes the wanted velocity. `pose` and `twist` are the newest estimate, `age_s` its age, `dt_s` the
  /// time since the last call. Once arrived it stays arrived until the next path, whatever corrections come.
  Wanted Step(const Pose2& pose, const Twist2& twist, double age_s, double dt_s);

 private:
  bool IsAtGoal(const Pose2& pose) const;
  void SeekOtherWay(const PathPlace& here, std::span<const Eigen::Vector2d> things);
  void TakeOtherWay(const OtherWay& other, const PathPlace& here, std::span<const Eigen::Vector2d> things);
  bool IsInDeadEnd(const PathPlace& here, bool leads_on, Time now);
  DetourConfig BeyondDeadEnds(const PathPlace& here) const;
  std::vector<Eigen::Vector2d> WithKnown(std::span<const Eigen::Vector2d> things) const;
  void ForgetClosed();
  void ForgetDeadEnds();
  Duration StandsFor(const PathPlace& here, Time now);
  void EndBackOff(const PathPlace& here, Time now);
  double PaceAt(double left_m) const;
  void MoveReference(const Pose2& pose, double dt_s);
  PathShape::Point ReferenceAt(double s) const;
  PathPlace Place() const;
  Wanted Report(const Pose2& pose, const PathShape::Point& reference) const;

  PathFollowerConfig config_;
  Footprint footprint_;
  std::optional<PathShape> shape_;
  Detour detour_;
  std::optional<Time> searched_;  ///< when a way around things was looked for
  /// A base that stays where it is.
  struct Stand {
    PathPlace at;
    Time since{};
  };
  DrivenWay driven_;
  std::optional<Stand> stands_;
  std::optional<Things> seeks_;       ///< another way is looked for in the next step, things taken so
  std::optional<OtherWay> back_off_;  ///< while the base goes back
  double smaller_to_m_ = -1;  ///< up to this arc length things are taken as smaller than they are heard
  double deepest_m_ = 0;      ///< arc length of the farthest dead end
  std::vector<Eigen::Vector2d> closed_;  ///< before the dead ends, map frame [m]
  std::vector<Eigen::Vector2d> known_;   ///< things that were known in the newest of them, likewise
  int back_offs_ = 0;                    ///< before that one
  Pose2 ahead_;                          ///< where the base will be when the wheels obey
  double s_ = 0;                         ///< arc length of the reference point on the path [m]
  double speed_ = 0;                     ///< last wanted ds/dt [m/s]
  bool arrived_ = false;
};

}  // namespace priamos::robot
