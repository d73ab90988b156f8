#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/archive.hpp"
#include "common/robot/body_size.hpp"
#include "world/core/base/bumper.hpp"
#include "world/core/base/contact.hpp"
#include "world/core/base/drive_board.hpp"
#include "world/core/base/mecanum_base.hpp"
#include "world/core/base/motor_load.hpp"
#include "world/core/head/camera_server.hpp"
#include "world/core/head/head_motors.hpp"
#include "world/core/head/mast.hpp"
#include "world/core/motion/movers.hpp"
#include "world/core/scene/hazards.hpp"
#include "world/core/scene/solid.hpp"
#include "world/core/sonar/sonar_ring.hpp"

namespace priamos::world {

/// The robot's body and devices as they are built, which may differ from what the robot and the planner
/// believe.
struct RobotModel {
  double length_m = kDrawnBody.length_m, width_m = kDrawnBody.width_m, height_m = kDrawnBody.height_m;
  MecanumConfig base;
  DriveBoardConfig drive;
  MotorLoadConfig motors;
  BumperConfig bumper;
  SonarConfig sonar;
  HeadMotorsConfig head_motors;
  CameraConfig camera;

  void Describe(Archive& a);
};

/// Where the wheels stand on the floor, base frame, in the order of messages.
using PerWheelPoints = std::array<Eigen::Vector2d, 4>;

/// Body of a robot that can touch things: a rectangle between two heights.
Body BodyOf(const RobotModel& model);

/// The encoders at one time.
struct WheelSample {
  Time time;
  WheelReading reading;
};

/// The currents of the four drives [A], and the switches of the bumper, at one time.
struct TouchSample {
  Time time;
  PerWheel current_a;
  std::uint8_t pressed;  ///< see Bumper; also those that were pressed since the sample before
};

/// A whole cycle of the sonars, complete at `time`; first echoes [m], -1 for none.
struct SonarSample {
  Time time;
  std::array<double, kSonars> ranges_m;
};

/// The head's step counters at one time, and whether a motor runs.
struct HeadSample {
  Time time;
  HeadSetting counters;
  bool moving;
};

/// A touch, when it begins.
struct TouchEvent {
  /// Who moved, as in world_touch_t: the base, a thing against it, or a wheel into a hole.
  enum class Kind { kDriven, kMovedIn, kFell };
  Time time;
  Kind kind;
  std::string thing;
  Eigen::Vector2d in_base;  ///< point of the footprint that was touched
};

/// True state of the robot at one time: pose, velocity, distances to solids, head.
struct Truth {
  Time time;
  Pose2 map_from_base;
  Twist2 velocity;  ///< base frame
  double gap_m = 0, min_gap_m = 0;
  int contacts = 0;  ///< those that the base drove into, and holes; not what came to it
  HeadAxes axes;
};

/// The whole world in steps of fixed length: wheels turn, the base moves or is blocked, people walk, motors
/// run, sonars fire, shutters open. Samples of the devices are taken at their own times; the newest of each
/// kind waits to be taken.
class Simulation {
 public:
  static constexpr Duration kStep{2500};
  static constexpr Duration kSamplePeriod{20000};  ///< wheels, head, truth
  /// Longest time that one call simulates. A caller that is later than this loses the rest: no time passes
  /// then.
  static constexpr Duration kMaxAdvance{500000};

  /// World with the robot at `start`; `cameras` must outlive it. `solids` are those of WithPeople. Throws
  /// std::invalid_argument when the robot would start inside a solid, a person or a hole.
  Simulation(const RobotModel& model, const std::vector<Solid>& solids, const Pose2& start,
             CameraServer& cameras, std::uint64_t seed, const Hazards& hazards = {});

  bool CommandWheels(Time now, std::int32_t instance, const PerWheel& speed_rad_s) {
    return drive_.Command(now, instance, speed_rad_s);
  }
  bool CommandHead(const HeadSetting& setting) { return motors_.Command(setting); }
  bool Trigger(Time now, std::int32_t frame_id, int cameras) {
    return cameras_.Trigger(now, frame_id, cameras);
  }

  /// Runs up to `now`; the first call sets the clock. Returns the time that was skipped, normally 0.
  Duration Advance(Time now);

  std::optional<WheelSample> TakeWheels() { return std::exchange(wheels_, {}); }
  std::optional<TouchSample> TakeTouch() { return std::exchange(touch_, {}); }
  std::optional<SonarSample> TakeSonars() { return std::exchange(sonars_, {}); }
  std::optional<HeadSample> TakeHead() { return std::exchange(head_, {}); }
  std::optional<Truth> TakeTruth() { return std::exchange(truth_, {}); }
  std::vector<TouchEvent> TakeTouchEvents() { return std::exchange(touch_events_, {}); }
  const Movers& movers() const { return movers_; }

 private:
  void Step();
  void Move(double dt_s);
  void MoveOthers(double dt_s);
  void BreakDevices();
  void UpdateGaps(double reach_m);
  void Touch();
  void Fall();
  void NoteTouch(const Clearance& clearance, bool driven);
  Rectangle Footprint() const { return {pose_, body_.size_m / 2}; }
  double SinceStart() const { return Seconds(*now_ - *started_); }
  double Reach(double dt_s) const;
  void ExposeUntil(Time end, const Pose2& from);
  void SampleDevices();
  Truth CurrentTruth() const;

  Body body_;
  PerWheelPoints wheels_in_base_;
  std::vector<std::string> names_;  ///< of the solids
  std::vector<HolePlan> holes_;
  FaultsPlan faults_;  ///< those that have not come yet
  DriveBoard drive_;
  MecanumBase base_;
  MotorLoad motor_load_;
  Bumper bumper_;
  SonarRing ring_;
  HeadMotors motors_;
  CameraServer& cameras_;
  Movers movers_;
  Mast mast_;
  Clearance clearance_;         ///< from what stands still
  Clearance moving_clearance_;  ///< from what moves by itself
  ContactCounter contacts_, moving_contacts_;
  int driven_into_movers_ = 0, falls_ = 0;

  Pose2 pose_;
  Twist2 velocity_;
  Twist2 driven_;  ///< what the wheels wanted in the last step
  double gap_m_ = 0;
  double moving_gap_m_ = 0, min_gap_m_ = 0;
  std::uint8_t pressed_ = 0;  ///< since the last sample
  std::optional<Time> now_, started_;
  Time next_sample_, next_ping_;
  int next_group_ = 0;

  std::optional<WheelSample> wheels_;
  std::optional<TouchSample> touch_;
  std::optional<SonarSample> sonars_;
  std::optional<HeadSample> head_;
  std::optional<Truth> truth_;
  std::vector<TouchEvent> touch_events_;
};

}  // namespace priamos::world
