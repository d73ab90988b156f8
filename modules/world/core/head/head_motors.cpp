#include "world/core/head/head_motors.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::world {

void HeadMotorsConfig::Describe(Archive& a) {
  a.Section("pan", pan, "turn of the platform, positive to the left");
  a.Section("tilt", tilt, "tilt of the platform, positive looks down");
  a.Section("vergence", vergence, "turn of each camera on the platform, positive to the left");
  a.Section("zoom", zoom, "focal length of each lens");
  a.Section("focus", focus, "distance of each lens");
}

HeadMotors::HeadMotors(const HeadMotorsConfig& config, const Rng& rng) {
  const std::array<const AxisConfig*, kAxes> configs{&config.pan,      &config.tilt, &config.vergence,
                                                     &config.vergence, &config.zoom, &config.zoom,
                                                     &config.focus,    &config.focus};
  Rng seeds = rng;
  const auto start = Flat(HeadSetting{});
  for (std::size_t i = 0; i < kAxes; ++i) axes_.emplace_back(*configs[i], start[i], Rng(seeds.engine()()));
}

std::array<double, HeadMotors::kAxes> HeadMotors::Flat(const HeadSetting& s) const {
  return {s.pan_rad,      s.tilt_rad,     s.vergence_rad[0], s.vergence_rad[1],
          s.zoom_step[0], s.zoom_step[1], s.focus_step[0],   s.focus_step[1]};
}

bool HeadMotors::Command(const HeadSetting& setting) {
  const auto targets = Flat(setting);
  if (!std::all_of(targets.begin(), targets.end(), [](double t) { return std::isfinite(t); })) return false;
  for (std::size_t i = 0; i < kAxes; ++i) axes_[i].MoveTo(targets[i]);
  return true;
}

void HeadMotors::Step(Duration step) {
  for (auto& axis : axes_) axis.Step(step);
}

bool HeadMotors::moving() const {
  return std::any_of(axes_.begin(), axes_.end(), [](const Axis& axis) { return axis.moving(); });
}

HeadSetting HeadMotors::Counters() const {
  const auto c = [this](std::size_t i) { return axes_[i].counter(); };
  return {c(kPan),
          c(kTilt),
          {c(kVergence), c(kVergence + 1)},
          {c(kZoom), c(kZoom + 1)},
          {c(kFocus), c(kFocus + 1)}};
}

HeadAxes HeadMotors::Truth() const {
  const auto p = [this](std::size_t i) { return axes_[i].position(); };
  return {p(kPan),
          p(kTilt),
          {p(kVergence), p(kVergence + 1)},
          {p(kZoom), p(kZoom + 1)},
          {p(kFocus), p(kFocus + 1)}};
}

}  // namespace priamos::world
