#pragma once

#include <array>
#include <cstdint>

namespace priamos::head {

/// Weights for one row of grey values around a line: first, second and third derivative, at a sub-pixel
/// position, of the row smoothed with a Gaussian and the pixel's own box. Unit: 1 / kScale.
struct alignas(16) EdgeKernel {
  static constexpr int kTaps = 16;
  static constexpr int kCentre = 7;  ///< the position lies between taps 7 and 8
  static constexpr double kScale = 1 << 14;

  std::array<std::int16_t, kTaps> first, second, third;
};

/// Kernels of one width for every sub-pixel phase.
struct EdgeKernelSet {
  static constexpr int kPhases = 64;

  explicit EdgeKernelSet(double sigma_px);

  double sigma_px;
  std::array<EdgeKernel, kPhases> phases;  ///< phase p is centred p + 1/2 steps after the pixel
  double first_gain = 0;                   ///< variance of the first derivative for pixel noise of 1
  double second_gain = 0;                  ///< variance of the second derivative for pixel noise of 1
};

/// Widths to choose from, normal to the edge.
enum class KernelWidth { kWide = 0, kNarrow = 1 };

/// The kernels for a line that crosses rows with |dx/dy| = `slope`, at most 1. Along the row they are wider
/// by 1/cos of its angle, so that their width normal to the edge is always the same.
const EdgeKernelSet& KernelsFor(KernelWidth width, double slope);

}  // namespace priamos::head
