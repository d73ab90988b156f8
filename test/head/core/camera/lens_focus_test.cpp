#include "head/core/camera/lens_focus.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace priamos::head {
namespace {

TEST(LensFocus, StepsOfTheRingAreEqualStepsOfInverseDistance) {
  const LensFocus lens{.nearest_m = 0.6, .infinity_step = 2000};
  EXPECT_NEAR(lens.DioptreAt(2000), 0, 1e-12);
  EXPECT_NEAR(lens.DioptreAt(0), 1 / 0.6, 1e-12);
  EXPECT_NEAR(lens.DioptreAt(1600), 1 / 3.0, 1e-12);
  for (const double dioptre : {0.0, 0.2, 1.0})
    EXPECT_NEAR(lens.DioptreAt(lens.StepFor(dioptre)), dioptre, 1e-12);
}

TEST(LensFocus, TheBlurOfAPointIsTheApertureSeenFromThere) {
  const LensFocus lens{.aperture_m = 0.016, .nearest_m = 0.6, .infinity_step = 2000, .sharp_px = 0.6};
  EXPECT_NEAR(lens.Blur(1000, 1600, 1 / 3.0), 0.6, 1e-9) << "in focus";
  // 16 mm out of focus by one dioptre are a disc of 16 px at 1000 px, 4 px sigma.
  EXPECT_NEAR(lens.Blur(1000, 1600, 1 / 3.0 + 1), std::hypot(0.6, 4), 1e-9);
  EXPECT_NEAR(lens.Blur(1000, 1600, 1 / 3.0 - 0.1), std::hypot(0.6, 0.4), 1e-9);
  EXPECT_NEAR(lens.Blur(1500, 1600, 1 / 3.0 + 1), std::hypot(0.6, 6), 1e-9) << "longer lenses are less deep";
}

}  // namespace
}  // namespace priamos::head
