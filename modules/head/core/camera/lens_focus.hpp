#pragma once

#include "common/archive.hpp"

namespace priamos::head {

/// How sharp a lens draws, as far as its maker says: the calibration table knows nothing of sharpness. The
/// focus ring turns in equal steps of inverse distance (the extension of a lens that is focused at a distance
/// much longer than its focal length), and the blur of a point out of focus is the aperture seen from there.
struct LensFocus {
  double aperture_m = 0.016;  ///< diameter of the entrance pupil; the same at all zooms
  double nearest_m = 0.6;     ///< distance in focus at focus step 0
  int infinity_step = 2000;   ///< focus step at which infinity is in focus
  double sharp_px = 0.6;      ///< sigma of the blur of what is in focus

  void Describe(Archive& a);

  /// Inverse of the distance in focus at a focus step [1/m].
  double DioptreAt(double focus_step) const;
  /// Focus step at which an inverse distance [1/m] is in focus; beyond the ends of the ring, where no motor
  /// turns it, if the distance is.
  double StepFor(double dioptre) const;
  /// Standard deviation [px] of the blur of a point at `dioptre` [1/m] through a lens of `focal_px` set to
  /// `focus_step`.
  double Blur(double focal_px, double focus_step, double dioptre) const;
};

}  // namespace priamos::head
