#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/drawing/drawing.hpp"

namespace priamos::drawing {

/// A picture of pixels, row by row from the top, each 0x00RRGGBB.
struct Raster {
  Raster(int width_px, int height_px, Colour background);

  std::uint32_t& At(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
  std::uint32_t At(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }

  int width, height;
  std::vector<std::uint32_t> pixels;
};

/// Paints the shapes of `drawing`, without its background, `scale` times as large onto `raster`.
void Paint(const Drawing& drawing, double scale, Raster& raster);
/// The drawing on its background.
Raster Paint(const Drawing& drawing, double scale = 1);

/// The bytes of a PNG file. Throws std::runtime_error when Cairo cannot make one.
std::string ToPng(const Raster& raster);

}  // namespace priamos::drawing
