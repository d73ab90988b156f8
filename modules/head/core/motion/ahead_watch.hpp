#pragma once

#include "common/archive.hpp"
#include "head/core/camera/head_setting.hpp"
#include "head/core/motion/glance_rhythm.hpp"

namespace priamos::head {

/// When and where the head looks ahead while the base drives.
struct AheadWatchConfig {
  bool ahead = false;       ///< glances ahead; without, the head waits for looks
  double tilt_deg = 12;     ///< down: what stands on the floor, from 1.3 m before the head on
  double max_pan_deg = 45;  ///< to the side, where the base drives sideways
  double every_s = 0.5;     ///< between the end of a glance and the beginning of the next one
  double idle_s = 3;        ///< time after a look from near, or an operator's motion, before the first glance

  void Describe(Archive& a);
};

/// Sequence of glances ahead, while the base drives and nobody else needs the head.
class AheadWatch : private GlanceRhythm {
 public:
  using GlanceRhythm::Defer;

  explicit AheadWatch(const AheadWatchConfig& config)
      : GlanceRhythm(config.every_s, config.idle_s), config_(config) {}

  /// One time step; true: begin a glance now. See GlanceRhythm::Step.
  bool Step(bool needed, bool glancing, bool drives, Time now) {
    return GlanceRhythm::Step(needed, glancing, drives && config_.ahead, now);
  }
  /// Whether there are glances at all.
  bool on() const { return config_.ahead; }
  /// The setting of a glance to where the base drives, `bearing_rad` from its front; vergence, zoom and focus
  /// as in `base`.
  HeadSetting SettingFrom(HeadSetting base, double bearing_rad) const;

 private:
  AheadWatchConfig config_;
};

}  // namespace priamos::head
