#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/time.hpp"
#include "robot/core/base/footprint.hpp"
#include "robot/core/safety/push_estimator.hpp"

namespace priamos::robot {

/// What shows that the base touches something.
struct TouchConfig {
  bool bumper = false;  ///< the base has one: its silence holds the base
  double push_n = 150;  ///< a larger force that acceleration and rolling do not explain is a touch
  double keep_s = 60;   ///< how long the place of a touch counts as an obstacle
  double told_s = 1.5;  ///< so long the base stands after a touch: until everybody has been told
  PushConfig push;

  void Describe(Archive& a);
};

/// Sides of the base where something was touched, as in bumper_t: two bits per side.
struct Touch {
  Time time{};
  std::uint8_t segments = 0;
  double push_n = 0;  ///< force by the currents; 0 when the bumper noticed it
  bool came = false;  ///< to a base that did not move that way: what it was may leave again
};

/// Notices that the base touches something, by the switches of the bumper and by the motor currents, and
/// keeps the places: what was touched is where no sonar saw it. A touch is noticed once: when a switch
/// closes, and when the force rises beyond its limit.
class TouchWatch {
 public:
  TouchWatch(const TouchConfig& config, const Footprint& footprint, const MecanumGeometry& geometry);

  void AddBumper(std::uint8_t pressed, Time time);
  void AddMotion(Time time, const Twist2& twist) { push_.AddMotion(time, twist); }
  void AddCurrents(const MotorCurrents& currents) { push_.AddCurrents(currents); }

  /// Looks for a new touch with the base at `odom_from_base`; nullopt when there is none. `motion`:
  /// velocity of a base of which is to be known whether something came to it; such a touch leaves no place.
  std::optional<Touch> Update(const Pose2& odom_from_base, Time now,
                              const std::optional<Twist2>& motion = std::nullopt);
  /// Whether a switch is closed.
  bool pressed() const { return pressed_ != 0; }
  /// Places of touches that still count, and switches that are closed now, base frame [m].
  std::vector<Eigen::Vector2d> Points(const Pose2& odom_from_base) const;
  /// Newest message of the bumper.
  const std::optional<Time>& bumper_heard() const { return bumper_heard_; }

 private:
  std::optional<Touch> TouchOfBumper(Time now);
  std::optional<Touch> TouchOfPush(Time now);
  void Remember(std::uint8_t segments, const Pose2& odom_from_base, Time now);

  struct Place {
    Eigen::Vector2d odom;
    Time time{};
  };

  TouchConfig config_;
  Footprint footprint_;
  PushEstimator push_;
  std::uint8_t pressed_ = 0, noticed_ = 0;  ///< switches that are closed, and those already reported
  bool pushes_ = false;
  std::optional<Time> bumper_heard_;
  std::deque<Place> places_;
};

/// In words, e.g. "the front's left half".
std::string SegmentsText(std::uint8_t segments);

}  // namespace priamos::robot
