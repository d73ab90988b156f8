#pragma once

#include <algorithm>
#include <cmath>

namespace priamos {

/// How a base comes to stand: it keeps its speed for the latency, then slows down evenly.
struct BrakingLaw {
  double deceleration_m_s2 = 1.0;
  double latency_s = 0.12;  ///< from an echo to wheels that obey it

  /// Distance until the base stands [m]: v t + v^2 / 2a.
  double Distance(double speed_m_s) const {
    return speed_m_s * latency_s + speed_m_s * speed_m_s / (2 * deceleration_m_s2);
  }
  /// Fastest speed from which the base stands within `free_m` [m/s]: the inverse of Distance(); 0 where
  /// nothing is free.
  double SpeedWithin(double free_m) const {
    const double a = deceleration_m_s2, lost = a * latency_s;
    return std::sqrt(lost * lost + 2 * a * std::max(0.0, free_m)) - lost;
  }
};

}  // namespace priamos
