#pragma once

#include <array>
#include <cmath>
#include <cstdlib>

namespace priamos::head {

/// Step counters of the KASTOR motors, as commanded and reported; a calibration belongs to one setting.
/// Signs and zeros are those of head_command_t: pan and vergence positive to the left, tilt positive down;
/// index 0 is the left camera.
struct HeadSetting {
  double pan_rad = 0, tilt_rad = 0;
  std::array<double, 2> vergence_rad{};
  std::array<int, 2> zoom_step{}, focus_step{};
};

/// True if all motors stand within `tolerance_rad` and one step of `b`.
inline bool IsSameSetting(const HeadSetting& a, const HeadSetting& b, double tolerance_rad = 1.5e-4) {
  bool same =
      std::abs(a.pan_rad - b.pan_rad) <= tolerance_rad && std::abs(a.tilt_rad - b.tilt_rad) <= tolerance_rad;
  for (int i = 0; i < 2; ++i) {
    same = same && std::abs(a.vergence_rad[i] - b.vergence_rad[i]) <= tolerance_rad &&
           std::abs(a.zoom_step[i] - b.zoom_step[i]) <= 1 && std::abs(a.focus_step[i] - b.focus_step[i]) <= 1;
  }
  return same;
}

}  // namespace priamos::head
