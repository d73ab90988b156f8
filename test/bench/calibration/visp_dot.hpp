#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

namespace priamos::bench {

#ifdef PRIAMOS_HAVE_VISP
inline constexpr bool kHaveVisp = true;
#else
inline constexpr bool kHaveVisp = false;
#endif

/// Grey values, row after row.
struct Pixels {
  const std::uint8_t* first;
  int width, height;
};

/// The centre of gravity that ViSP's vpDot2 finds of the bright dot at (u, v) [px]; nullopt without ViSP.
std::optional<Eigen::Vector2d> VispDot(const Pixels& image, double u, double v);

}  // namespace priamos::bench
