#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/time.hpp"

namespace priamos {

inline constexpr std::size_t kAxes = 6;

/// Names of the axes as an operator sees the cap of a space-mouse: pushed away from him, to the left, pulled
/// up; tilted about the same directions by the right-hand rule, so that `turn` is counter-clockwise from
/// above.
inline const std::vector<std::string> kAxisNames{"forward", "left", "up", "roll", "pitch", "turn"};

/// State of an input device.
struct Stick {
  std::array<double, kAxes> axis{};  ///< deflection -1..1, order of kAxisNames
  std::uint32_t buttons = 0;         ///< bit i: button i is pressed
  bool connected = false;
  Time heard{};  ///< time of the device's newest report; a device that is deflected keeps talking
  bool operator==(const Stick&) const = default;
};

inline bool IsPressed(const Stick& stick, int button) {
  return button >= 0 && button < 32 && (stick.buttons >> button & 1u) != 0;
}

}  // namespace priamos
