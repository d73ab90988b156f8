#pragma once

#include <optional>

#include "common/time.hpp"
#include "head/core/camera/head_setting.hpp"

namespace priamos::head {

/// An operator's wish for the motion of the head, per second; signs as in head_drive_t.
struct HeadWish {
  Time time{};
  Duration time_to_live{};
  int session = 0, sequence = 0;
  double pan_rad_s = 0, tilt_rad_s = 0, vergence_rad_s = 0, zoom_step_s = 0, focus_step_s = 0;
};

/// Moves the head by hand: adds up the wishes from where the head stands. A wish that is old, or not newer
/// than the last one of the same sender, is refused and counted; silence stops the head.
class HeadJog {
 public:
  /// Returns whether it is taken.
  bool Take(const HeadWish& wish, Time now);
  /// What to command now, every 50 ms while a wish to move is valid. `here`: where the motors are.
  std::optional<HeadSetting> Step(const HeadSetting& here, Time now);
  /// Somebody else moves the head now.
  void Stop() {
    target_.reset();
    wish_.reset();
  }
  int refused() const { return refused_; }

 private:
  std::optional<HeadWish> wish_, newest_;
  std::optional<HeadSetting> target_;
  Time stepped_{};
  int refused_ = 0;
};

}  // namespace priamos::head
