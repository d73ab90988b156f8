#pragma once

#include <optional>

#include "common/time.hpp"
#include "head/core/camera/head_setting.hpp"

namespace priamos::head {

/// Velocities that an operator orders for the head; signs as in head_drive_t.
struct HeadWish {
  Time time{};
  Duration time_to_live{};
  int session = 0, sequence = 0;
  double pan_rad_s = 0, tilt_rad_s = 0, vergence_rad_s = 0, zoom_step_s = 0, focus_step_s = 0;
};

/// Moves the head by hand: integrates the ordered velocities from where the head stands. An order that is
/// old, or not newer than the last one of the same sender, is refused and counted; without orders the head
/// stops.
class HeadJog {
 public:
  /// Takes an order; returns whether it was accepted.
  bool Take(const HeadWish& wish, Time now);
  /// The setting to command, every 50 ms while an order is valid. `here`: where the motors are.
  std::optional<HeadSetting> Step(const HeadSetting& here, Time now);
  /// Drops the current order, because somebody else moves the head now.
  void Stop() {
    target_.reset();
    wish_.reset();
  }
  /// Whether an operator moves the head; one who paused for less than half a second still does.
  bool IsHeld(Time now) const;
  int refused() const { return refused_; }

 private:
  std::optional<HeadWish> wish_, newest_;
  std::optional<HeadSetting> target_;
  std::optional<Time> moved_;  ///< when a setting was commanded last
  Time stepped_{};
  int refused_ = 0;
};

}  // namespace priamos::head
