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
    const double lost_m_s = deceleration_m_s2 * latency_s;
    return SpeedBefore(lost_m_s, free_m) - lost_m_s;
  }
  /// Fastest speed from which a base that already slows down has come to `end_m_s` after `distance_m` [m/s]:
  /// the latency is over; `end_m_s` where no distance is left.
  double SpeedBefore(double end_m_s, double distance_m) const {
    return std::sqrt(end_m_s * end_m_s + 2 * deceleration_m_s2 * std::max(0.0, distance_m));
  }
};

}  // namespace priamos
