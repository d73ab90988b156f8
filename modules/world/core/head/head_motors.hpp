#pragma once

#include <array>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/robot/robot_drawing.hpp"
#include "world/core/camera/optics.hpp"
#include "world/core/head/axis.hpp"

namespace priamos::world {

/// The motors of KASTOR. Play and repeatability are those of stepper motors with spur or worm gears; at a
/// focal length of 1000 px, 0.0001 rad is 0.1 px.
struct HeadMotorsConfig {
  AngleAxisConfig pan{{.min = -kDrawnHead.most_pan_rad,
                       .max = kDrawnHead.most_pan_rad,
                       .step = 0.0001,
                       .speed = 1.5,
                       .acceleration = 6,
                       .backlash = 0.0004,
                       .repeatability = 0.00003}};
  AngleAxisConfig tilt{{.min = -kDrawnHead.most_tilt_rad,
                        .max = kDrawnHead.most_tilt_rad,
                        .step = 0.0001,
                        .speed = 1,
                        .acceleration = 4,
                        .backlash = 0.0004,
                        .repeatability = 0.00003}};
  AngleAxisConfig vergence{{.min = -kDrawnHead.most_vergence_rad,
                            .max = kDrawnHead.most_vergence_rad,
                            .step = 0.0001,
                            .speed = 0.8,
                            .acceleration = 4,
                            .backlash = 0.0003,
                            .repeatability = 0.00002}};
  LensAxisConfig zoom{{.min = 0,
                       .max = kDrawnHead.most_step,
                       .step = 1,
                       .speed = 800,
                       .acceleration = 4000,
                       .backlash = 6,
                       .repeatability = 0.4}};
  LensAxisConfig focus{{.min = 0,
                        .max = kDrawnHead.most_step,
                        .step = 1,
                        .speed = 800,
                        .acceleration = 4000,
                        .backlash = 6,
                        .repeatability = 0.4}};

  void Describe(Archive& a);
};

/// Set values or step counters: pan and tilt, then per camera (left, right).
struct HeadSetting {
  double pan_rad = 0, tilt_rad = 0;
  std::array<double, 2> vergence_rad{};
  std::array<double, 2> zoom_step{650, 650};
  std::array<double, 2> focus_step{1600, 1600};
};

/// Eight axes. After power-on they rest at the default HeadSetting.
class HeadMotors {
 public:
  HeadMotors(const HeadMotorsConfig& config, const Rng& rng);

  /// A command that is not finite is refused as a whole; values beyond the end stops are clamped.
  bool Command(const HeadSetting& setting);
  void Step(Duration step);

  HeadSetting Counters() const;
  bool moving() const;
  /// True positions of the axes.
  HeadAxes Truth() const;

 private:
  enum : std::size_t { kPan, kTilt, kVergence, kZoom = 4, kFocus = 6, kAxes = 8 };
  std::array<double, kAxes> Flat(const HeadSetting& setting) const;

  std::vector<Axis> axes_;
};

}  // namespace priamos::world
