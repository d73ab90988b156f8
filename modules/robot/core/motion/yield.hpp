#pragma once

#include <optional>

#include "common/archive.hpp"
#include "common/time.hpp"

namespace priamos::robot {

/// Somebody who comes towards the base.
struct Comer {
  double free_m = 0;     ///< from the footprint
  double speed_m_s = 0;  ///< over the floor, towards the base
  double left_m = 0;     ///< beside the middle of the base
};

/// When a base makes room for who comes.
struct YieldConfig {
  double ahead_s = 1.5;     ///< from so long before they would meet ...
  double ahead_m = 0.8;     ///< ... and this on the base does not go ahead
  double near_m = 1.2;      ///< who is so near sees a base that stands
  double aside_m_s = 0.25;  ///< fastest velocity to the side
  double gain_per_s = 1.5;  ///< velocity to the side per distance
  double wait_s = 2;        ///< time without anybody coming until it goes on
  double patience_s = 8;    ///< time that who stands so near is waited for

  void Describe(Archive& a);
};

/// Makes room in a corridor: does not go ahead while somebody comes, goes to the side on which he is not, and
/// stands there. Who walks past finds a base at the wall; who walks into it has walked into one that stands.
class Yield {
 public:
  explicit Yield(const YieldConfig& config) : config_(config) {}

  /// Velocity to the left [m/s] in place of driving on; nullopt: drive on. `offset_m`: of the base to the
  /// left of the corridor's middle, which it may be `room_m` off. `comer`: the nearest one, if any.
  std::optional<double> Step(const std::optional<Comer>& comer, double offset_m, double room_m, Time now);
  void End() { since_ = last_ = std::nullopt; }

 private:
  YieldConfig config_;
  std::optional<Time> since_;  ///< when somebody came last, while the base makes room
  std::optional<Time> last_;   ///< when somebody came last
  double side_ = 0;            ///< 1: to the left
};

}  // namespace priamos::robot
