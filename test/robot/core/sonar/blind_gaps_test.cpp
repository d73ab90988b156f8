// How large a thing can be that no sonar sees: modules/robot/FIGURES.md.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "robot/core/sonar/echo_memory.hpp"

namespace priamos::robot {
namespace {

constexpr double kGrid = 0.005;

/// Distance of `point` from the cone that a sensor at the origin hears, x ahead; 0 inside.
double FromBeam(const Eigen::Vector2d& point, double half_beam) {
  const double beside = std::atan2(std::abs(point.y()), point.x()) - half_beam;
  if (beside <= 0) return 0;
  return point.norm() * (beside < M_PI / 2 ? std::sin(beside) : 1);
}

/// Distance of `point` from the nearest beam of the ring: a round post of this radius is just not heard
/// there.
double FromBeams(const Eigen::Vector2d& point) {
  double nearest = 9;
  for (int i = 0; i < kSonars; ++i)
    nearest = std::min(nearest, FromBeam(BaseFromSonar(i, Footprint().Size()).Inverse() * point,
                                         Radians(EchoMemoryConfig().half_beam_deg)));
  return nearest;
}

/// Calls `look(largest radius of a post that is not heard there, distance from the base)`. One quarter of the
/// ring is like the others.
template <class Look>
void ForEveryPlaceWithin(double reach_m, const Look& look) {
  const Footprint base;
  const double x_end = base.length_m / 2 + reach_m, y_end = base.width_m / 2 + reach_m;
  for (double x = 0; x <= x_end; x += kGrid)
    for (double y = 0; y <= y_end; y += kGrid) {
      const double gap = base.Distance({x, y});
      if (gap > 0 && gap <= reach_m) look(std::min(FromBeams({x, y}), gap), gap);
    }
}

/// Share of the places at which no sonar hears a post of this diameter, among those at most 13 cm beside the
/// base.
double Unheard(double diameter_m) {
  int all = 0, unheard = 0;
  ForEveryPlaceWithin(0.25, [&](double radius, double gap) {
    if (gap < diameter_m / 2 || gap - diameter_m / 2 > 0.13) return;
    ++all;
    unheard += radius >= diameter_m / 2;
  });
  return double(unheard) / all;
}

TEST(BlindGaps, NoPostThickerThanFifteenCentimetresIsUnheardAnywhere) {
  double largest = 0;
  ForEveryPlaceWithin(1.0, [&](double radius, double) { largest = std::max(largest, radius); });
  EXPECT_NEAR(2 * largest, 0.144, 0.003);
}

TEST(BlindGaps, APostIsUnheardAtSoManyPlacesBesideTheBase) {
  EXPECT_NEAR(Unheard(0.04), 0.56, 0.03);
  EXPECT_NEAR(Unheard(0.10), 0.16, 0.03);
  EXPECT_EQ(Unheard(0.15), 0);
}

}  // namespace
}  // namespace priamos::robot
