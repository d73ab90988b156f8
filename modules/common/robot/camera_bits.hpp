#pragma once

namespace priamos {

/// Bit of one camera in an order for an exposure (camera_trigger_t): 0 left, 1 right, 2 third.
constexpr int CameraBit(int camera) {
  return 1 << camera;
}
/// Bits of the first `cameras` cameras.
constexpr int CameraBits(int cameras) {
  return (1 << cameras) - 1;
}
/// Bit of such an order that turns the line laser on.
inline constexpr int kLaserBit = 1 << 3;

}  // namespace priamos
