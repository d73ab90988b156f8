#include "head/core/camera/lens_focus.hpp"

#include <cmath>

namespace priamos::head {

void LensFocus::Describe(Archive& a) {
  a.Number("aperture_m", aperture_m,
           {"m", 0.0001, 0.1, "diameter of the entrance pupil: focal length over f-number"});
  a.Number("nearest_m", nearest_m, {"m", 0.05, 10, "distance in focus at focus step 0, as on the ring"});
  a.Integer("infinity_step", infinity_step, {"step", 1, 10000, "focus step at which infinity is in focus"});
  a.Number("sharp_px", sharp_px, {"px", 0.2, 5, "sigma of the blur in focus: lens, pixels, movement"});
}

double LensFocus::DioptreAt(double focus_step) const {
  return (1 - focus_step / infinity_step) / nearest_m;
}

double LensFocus::StepFor(double dioptre) const {
  return infinity_step * (1 - dioptre * nearest_m);
}

double LensFocus::Blur(double focal_px, double focus_step, double dioptre) const {
  // A point out of focus is a disc as wide as the aperture over its distance from what is in focus. The
  // standard deviation of a disc along one axis is a quarter of its diameter.
  const double disc_px = focal_px * aperture_m * std::abs(DioptreAt(focus_step) - dioptre);
  return std::hypot(sharp_px, disc_px / 4);
}

}  // namespace priamos::head
