#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "common/archive.hpp"
#include "common/random.hpp"
#include "common/robot/robot_drawing.hpp"
#include "common/time.hpp"

namespace priamos::world {

/// One value per wheel: front left, front right, rear left, rear right; positive drives forward.
using PerWheel = std::array<double, 4>;

/// The board with the four speed controllers, gears and encoders.
struct DriveBoardConfig {
  double max_speed_rad_s = kDrawnWheels.max_rad_s;
  double acceleration_rad_s2 = 15;
  double braking_rad_s2 = 30;
  double lag_s = 0.04;
  double deadline_s = 0.2;
  int ticks_per_turn = kDrawnWheels.ticks_per_turn;
  double encoder_noise_ticks = 0.7;

  void Describe(Archive& a);
};

/// State of the drive board: encoder counts, and whether it holds the wheels.
struct WheelReading {
  std::array<std::int32_t, 4> position_ticks{};  ///< since power-on, wraps around
  bool deadline_stopped = true;  ///< true: the wheels are held, because no command came for the deadline
  bool contested = false;  ///< true: the wheels are held, because two instances commanded within the deadline
  std::int32_t instance = 0;          ///< instance whose command was obeyed last; 0 before the first
  std::int32_t foreign_commands = 0;  ///< commands of other instances, not obeyed
};

/// Four wheel drives: the set value runs along a ramp, the wheel follows the ramp with a first-order lag.
/// Before the first command, and when none came for the deadline, the set value is 0 and the ramp steeper:
/// this is the board's own safety, independent of everything that sends commands.
///
/// It obeys one instance at a time, and only while that one commands alone. A command of another one is
/// counted, not obeyed, and holds the wheels for the deadline, and until they stand; only when the first one
/// has been silent for the deadline, the other takes its place.
class DriveBoard {
 public:
  DriveBoard(const DriveBoardConfig& config, Rng rng) : config_(config), rng_(rng) {}

  /// A command arrived. Speeds beyond the limit are clamped. A command that is not finite is refused as a
  /// whole and does not feed the deadline; returns false for that one. `instance` names who commands.
  bool Command(Time arrival, std::int32_t instance, const PerWheel& speed_rad_s);
  /// From now on this motor stands, and its wheel with it.
  void Stall(std::size_t wheel) { stalled_.at(wheel) = true; }
  /// Advances by one physics step that ends at `now`.
  void Step(Time now, Duration step);

  const PerWheel& speed_rad_s() const { return speed_rad_s_; }
  /// The state as a reading at this time gives it: whole ticks, with the jitter of the pulse edges.
  WheelReading Read();

 private:
  bool Silent(Time now) const;
  bool Stands() const;
  bool Contested(Time now) const;

  DriveBoardConfig config_;
  Rng rng_;
  std::optional<Time> last_command_, last_foreign_;
  std::int32_t instance_ = 0, foreign_commands_ = 0;
  PerWheel set_rad_s_{}, ramp_rad_s_{}, speed_rad_s_{}, turned_rad_{};
  bool deadline_stopped_ = true, contested_ = false;
  std::array<bool, 4> stalled_{};
};

}  // namespace priamos::world
