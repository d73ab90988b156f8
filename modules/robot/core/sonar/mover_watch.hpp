#pragma once

#include <Eigen/Core>
#include <array>
#include <deque>
#include <optional>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/sonar_ring.hpp"
#include "common/time.hpp"
#include "robot/core/base/footprint.hpp"
#include "robot/core/sonar/sonar_cycle.hpp"

namespace priamos::robot {

/// When an echo is that of something that comes towards the base, and what is kept free of it.
struct MoverConfig {
  double ahead_deg = 50;     ///< of who comes by a sensor farther off the heading nothing is kept free
  double window_s = 0.5;     ///< echoes of so long decide
  double least_m_s = 0.35;   ///< slower things count as standing
  double residual_m = 0.12;  ///< a larger error of the line through the echoes is no motion
  double gate_m = 0.35;      ///< a mover's next echo lies so near to where it is expected
  double lost_s = 1;         ///< without an echo it is forgotten after this ...
  double standing_s = 90;    ///< ... and counts as an ordinary thing when it has stood for so long
  double walks_s = 1;        ///< who has not come nearer for so long since it was found was none
  double horizon_s = 1.2;    ///< the strip before it, which it will walk over in this time, is not entered
  double body_m = 0.28;      ///< so far feet and shoulders reach beyond what the sonars hear of the legs

  void Describe(Archive& a);
};

/// Something that has come towards the base, frame of the odometry. Beside a base that drives things that
/// stand are sometimes taken for movers: so one that was heard only beside it keeps nothing free, and hides
/// nothing.
struct Mover {
  Eigen::Vector2d at{0, 0};        ///< where it was heard last
  Eigen::Vector2d velocity{0, 0};  ///< over the floor, along the beam that hears it [m/s]
  Time seen{};
  Eigen::Vector2d stood_at{0, 0};  ///< where it has been since `stood`
  Time stood{};
  bool beside = false;                            ///< it was never heard ahead
  Eigen::Vector2d found_at{0, 0}, heading{0, 0};  ///< where it was found, and where it was going
  Time found{};
  bool walks = false;  ///< it went on since: it is no edge that a beam met
};

/// Finds what comes towards the base, a person above all, by successive echoes. A sonar tells the distance:
/// the place of an echo along the axis of its sensor, in the frame of the odometry, does not change for what
/// stands, however the base drives, and decreases evenly for what comes. A line through the echoes of half a
/// second decides. From then on the mover is followed by its nearest echo, also when it stands or leaves.
/// What crosses without coming nearer is not found.
class MoverWatch {
 public:
  MoverWatch(const MoverConfig& config, const Footprint& footprint);

  /// Takes a cycle of the sonars. `odom_from_base`: pose when the cycle ended.
  void Add(const SonarCycle& cycle, const Pose2& odom_from_base);
  const std::vector<Mover>& movers() const { return movers_; }
  /// Whether a mover, wherever it comes from, will be so near to the footprint in `within_s` that body and
  /// base touch. `velocity`: of the base, in its frame [m/s].
  bool IsAboutToMeet(const Pose2& odom_from_base, const Eigen::Vector2d& velocity, double within_s) const;
  /// The mover nearest to the base before it, at `odom_from_base`; nullptr when there is none.
  const Mover* NearestAhead(const Pose2& odom_from_base) const;
  /// Whether an echo at `odom` is that of a mover.
  bool IsOfMover(const Eigen::Vector2d& odom) const;
  /// Places around the movers, and those before them that they will walk over soon, outside of the footprint;
  /// base frame of `odom_from_base` [m].
  std::vector<Eigen::Vector2d> Points(const Pose2& odom_from_base) const;

 private:
  /// An echo, as a place along the axis of its sensor.
  struct Sample {
    Time time{};
    Eigen::Vector2d sonar{0, 0};
    double range_m = 0;
  };
  std::optional<double> ClosingSpeed(const std::deque<Sample>& samples, const Eigen::Vector2d& axis,
                                     double residual_m) const;
  /// What comes, by one sensor.
  struct Coming {
    Eigen::Vector2d at, velocity;
    bool beside = false;
  };
  bool Keep(std::deque<Sample>& samples, Time now, const Pose2& odom_from_sonar, double range_m) const;
  std::optional<Coming> ComingIn(const std::deque<Sample>& samples, const Pose2& odom_from_sonar) const;
  void Follow(const std::vector<Eigen::Vector2d>& echoes, Time now);
  void NoteWalk(Mover& mover, Time now) const;
  bool IsNone(const Mover& mover, Time now) const;
  void Found(const Coming& coming, Time now);

  MoverConfig config_;
  Footprint footprint_;
  std::array<std::deque<Sample>, kSonars> heard_;
  std::vector<Mover> movers_;
  std::optional<Pose2> last_pose_;
  std::optional<Time> last_;
};

}  // namespace priamos::robot
