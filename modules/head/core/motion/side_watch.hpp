#pragma once

#include <optional>

#include "common/archive.hpp"
#include "common/time.hpp"
#include "head/core/camera/head_setting.hpp"
#include "head/core/motion/glance_rhythm.hpp"

namespace priamos::head {

/// When and where the head looks for doors while the base drives.
struct SideWatchConfig {
  bool corridors = false;  ///< glances in corridors; without, the head waits for looks
  double pan_deg = 28;     ///< to either side in turn
  double tilt_deg = -10;   ///< up: the lintel is near when seen from within a corridor
  int zoom_step = 100;
  double every_s = 0.2;  ///< between the end of a glance and the beginning of the next one
  double idle_s = 2;     ///< time after a look from near, or an operator's motion, before the first glance

  void Describe(Archive& a);
};

/// Sequence of glances to the left and to the right in turn, while the base follows a corridor and nobody
/// else needs the head.
class SideWatch : private GlanceRhythm {
 public:
  using GlanceRhythm::Defer;

  explicit SideWatch(const SideWatchConfig& config)
      : GlanceRhythm(config.every_s, config.idle_s), config_(config) {}

  /// One time step; a pan angle [rad]: begin a glance there. `follows`: the base drives along a corridor; see
  /// GlanceRhythm::Step.
  std::optional<double> Step(bool needed, bool glancing, bool follows, Time now);
  /// The setting of a glance at `pan_rad`; vergence and focus as in `base`.
  HeadSetting SettingAt(double pan_rad, HeadSetting base) const;

 private:
  SideWatchConfig config_;
  int side_ = 1;
};

}  // namespace priamos::head
