#pragma once

#include <vector>

#include "common/archive.hpp"

namespace priamos::robot {

/// How far ahead a way around things is looked for, and how far off them it keeps.
struct DetourConfig {
  double horizon_m = 2.5;  ///< distance ahead on the path
  double least_m = 0.02;   ///< nearer to a thing than this no detour leads
  double stop_m = 0.11;  ///< nearer than this the collision stop brakes who drives towards it: only a way out
  double wish_m = 0.20;  ///< nearer than this only where there is no room
  double replan_s = 0.2;  ///< time between two searches

  void Describe(Archive& a);
};

/// A way beside a path: the distance to its left (negative: right) over its arc length. The one that is made
/// without arguments stays on the path.
class Detour {
 public:
  Detour() = default;
  /// Distances [m] at `from`, `from + step`, ... [m of arc length].
  Detour(double from, double step, std::vector<double> offsets_m);

  /// Distance from the path at the arc length `s` [m]; beyond its end that of the end.
  double At(double s) const;
  /// Change of the distance per metre of the path.
  double SlopeAt(double s) const;
  /// The same beside a path that begins at the arc length `s` of this one's.
  Detour From(double s) const {
    Detour same = *this;
    same.from_ -= s;
    return same;
  }
  /// Where it was looked for: the arc length at which it begins.
  double from() const { return from_; }
  /// Whether it leaves the path anywhere.
  bool leaves() const { return leaves_; }
  /// Whether it leads as far ahead as was looked, and at the end of the path to a goal that is free. One that
  /// does not ends before what closes the way.
  bool leads_on() const { return leads_on_; }
  /// The same one, of which that is known.
  Detour Leading(bool on) const {
    Detour same = *this;
    same.leads_on_ = on;
    return same;
  }

 private:
  double from_ = 0, step_ = 1;
  std::vector<double> offsets_m_;
  bool leaves_ = false, leads_on_ = true;
};

/// How a search takes things: as they are, or as so much smaller as sonars show them too large, by 10 cm at
/// most. What stops the base does not wait for it.
enum class Things { kAsHeard, kSmaller };

/// A place on a path: arc length, and how far the base stands to its left [m].
struct PathPlace {
  double s = 0, offset_m = 0;
};

}  // namespace priamos::robot
