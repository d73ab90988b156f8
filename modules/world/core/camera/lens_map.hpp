#pragma once

#include <deque>
#include <vector>

#include "world/core/camera/optics.hpp"

namespace priamos::world {

/// Where every pixel of a camera looks on the fine grid, and how much light its lens leaves there. It stays
/// the same while zoom and focus stand.
class LensMap {
 public:
  /// Four neighbouring cells of the fine grid and the place between them.
  struct Pixel {
    int cell = 0;      ///< index of the upper left one
    float right = 0;   ///< 0..1, towards the right ones
    float down = 0;    ///< 0..1, towards the lower ones
    double light = 1;  ///< part of the light that is left
  };

  /// `vignetting`: loss of light in the corners at 800 px focal length.
  LensMap(const TrueCamera& camera, double vignetting);

  /// Whether it is the map of such a camera, wherever that stands.
  bool IsOf(const TrueCamera& camera, double vignetting) const;
  /// Row by row.
  const std::vector<Pixel>& pixels() const { return pixels_; }

 private:
  TrueCamera camera_;
  double vignetting_;
  std::vector<Pixel> pixels_;
};

/// The maps used last: those of three cameras, each for two settings of its lens.
class LensMaps {
 public:
  /// The map of this camera; valid until the next call.
  const LensMap& Of(const TrueCamera& camera, double vignetting);

 private:
  std::deque<LensMap> newest_first_;
};

}  // namespace priamos::world
