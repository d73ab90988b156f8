#pragma once

#include <cmath>
#include <optional>

#include "robot/core/motion/drive_controller.hpp"
#include "robot/core/pose/localiser.hpp"
#include "robot/core/sonar/segment_finder.hpp"
#include "test/robot/support/simulated_base.hpp"
#include "test/robot/support/simulated_sonars.hpp"

namespace priamos::robot {

/// The robot's thinking on a simulated base with simulated sonars, ticked at 50 Hz. Wheels, sonars and the
/// controller's own commands can be cut.
class RobotRig {
 public:
  RobotRig(std::uint64_t seed, const Pose2& truth, const LocaliserConfig& localiser = LocaliserConfig(),
           const DriveConfig& drive = DriveConfig(), std::vector<Surface> surfaces = {})
      : base_(seed, truth),
        sonars_(seed, std::move(surfaces)),
        localiser_(localiser, MecanumGeometry(), drive.footprint),
        drive_(drive, MecanumGeometry()),
        finder_({.groups = 1}, localiser.odometry.noise, drive.footprint) {}

  bool wheels_answer = true, sonars_answer = true, wheels_turn = true, head_answers = true;
  bool finds_walls = false;  ///< the controller is told of walls that the ring shows
  Duration link_down{};

  SimulatedBase& base() { return base_; }
  SimulatedSonars& sonars() { return sonars_; }
  Localiser& localiser() { return localiser_; }
  DriveController& drive() { return drive_; }
  const DriveState& state() const { return drive_.state(); }
  const std::optional<WheelSpeeds>& command() const { return command_; }
  Time now() const { return base_.now(); }
  double min_gap() const { return min_gap_; }

  PathVerdict SetPath(const Path& path) { return drive_.SetPath(path, now()); }

  /// One command of `who`, as of now.
  CommandVerdict Command(const LeaseHolder& who, const Twist2& twist) {
    return drive_.SetCommand({now(), who, ++sequence_ & 0xffff, std::chrono::milliseconds(200), twist},
                             now());
  }
  /// The lease, and the stick at rest.
  void TakeOver(const LeaseHolder& who) {
    drive_.RequestLease(who, Lease::Wish::kTakeOver, now());
    Command(who, {});
  }
  /// `who` holds the stick for a while, 25 commands per second.
  void Hold(const LeaseHolder& who, const Twist2& twist, double seconds) {
    for (int i = 0; i < seconds * 50; ++i) {
      if (i % 2 == 0) Command(who, twist);
      Tick();
    }
  }

  void Tick() {
    base_.Advance(std::chrono::milliseconds(20));
    const WheelSample sample = base_.Read();
    if (wheels_answer && localiser_.AddWheels(sample, now())) heard_ = now();
    if (sonars_answer && tick_ % 5 == 0) {
      const SonarCycle cycle = sonars_.Listen(now(), base_.truth());
      drive_.AddSonar(cycle, localiser_.odometry().pose());
      localiser_.AddSonar(cycle);
      if (finds_walls)
        for (const FoundSegment* found : finder_.Add(cycle, localiser_.odometry().pose()))
          drive_.AddWall(found->number, {found->wall.from(), found->wall.to(),
                                         std::sqrt(found->wall.line().covariance(0, 0))});
    }
    answers_ = localiser_.Step(now());
    command_ = drive_.Step({localiser_.estimate(), localiser_.odometry().pose(), heard_,
                            head_answers ? std::optional(now()) : std::nullopt, link_down},
                           now());
    if (link_down > Duration::zero()) link_down += std::chrono::milliseconds(20);
    if (command_ && wheels_turn) base_.Command(*command_, now());
    if (++tick_ % 5 == 0) min_gap_ = std::min(min_gap_, sonars_.Gap(base_.truth()));
  }
  void Run(double seconds) {
    for (int i = 0; i < seconds * 50; ++i) Tick();
  }
  const std::vector<Localiser::Answer>& answers() const { return answers_; }

 private:
  SimulatedBase base_;
  SimulatedSonars sonars_;
  Localiser localiser_;
  DriveController drive_;
  SegmentFinder finder_;
  std::optional<Time> heard_;
  std::optional<WheelSpeeds> command_;
  std::vector<Localiser::Answer> answers_;
  int tick_ = 0, sequence_ = 0;
  double min_gap_ = 9;
};

}  // namespace priamos::robot
