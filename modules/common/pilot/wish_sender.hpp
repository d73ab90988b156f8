#pragma once

#include <optional>

#include "common/time.hpp"

namespace priamos {

/// When to send on one stream of wishes: at once when the stick leaves rest or jumps, else periodically;
/// three explicit zeros when it comes to rest, the first one at once; then silence, or a slow repetition
/// while the operator holds on. A jump waits for half a period after the last wish.
class WishSender {
 public:
  /// How the stick is held.
  enum class Stick { kDeflected, kHeld, kReleased };  ///< held: at rest, but in the hand

  WishSender(Duration period, Duration rest_period) : period_(period), rest_period_(rest_period) {}

  /// Whether to send now. `jumped`: the wish is quite another one than the one sent last.
  bool Step(Stick stick, bool jumped, Time now);
  std::optional<Time> last() const { return last_; }

 private:
  static constexpr int kZeros = 3;
  bool Due(Duration period, Time now) const;
  bool Sent(Time now);

  Duration period_, rest_period_;
  int zeros_left_ = 0;
  std::optional<Time> last_;
};

}  // namespace priamos
