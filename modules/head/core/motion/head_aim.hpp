#pragma once

#include <optional>

#include "common/time.hpp"
#include "head/core/camera/head_setting.hpp"

namespace priamos::head {

/// Where an operator points the head; signs as in head_aim_t. What has no value stays as it is.
struct HeadAim {
  Time time{};
  double pan_rad = 0, tilt_rad = 0;
  std::optional<double> vergence_rad;  ///< of each camera, towards the other
  std::optional<int> zoom_step, focus_step;
};

/// Takes an operator's aims and makes settings of them. One that is old, older than the last one, or no
/// number is refused and counted; one that is said again is the same.
class AimKeeper {
 public:
  /// An aim older than this is not obeyed; the head stays where it was pointed for kHeld at least.
  static constexpr Duration kLongestLife = std::chrono::seconds(3), kHeld = std::chrono::seconds(10);

  /// Returns whether it is a new one that was accepted.
  bool Take(const HeadAim& aim, Time now);
  /// The setting to go to, once for each aim; nullopt: none waits, or it waited too long. `here`: where the
  /// motors are.
  std::optional<HeadSetting> Next(const HeadSetting& here, Time now);
  /// Whether an operator pointed the head somewhere just now.
  bool IsHeld(Time now) const { return aimed_ && now - *aimed_ < kHeld; }
  int refused() const { return refused_; }

 private:
  std::optional<HeadAim> waiting_;
  std::optional<Time> newest_, aimed_;
  int refused_ = 0;
};

}  // namespace priamos::head
