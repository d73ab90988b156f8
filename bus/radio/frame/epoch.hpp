#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "bus/radio/frame/frame.hpp"

namespace priamos::bus::radio {

/// Source of fresh random numbers: unpredictable on a robot, seeded in a simulation.
using NonceSource = std::function<std::uint64_t()>;

/// Agreement on an epoch after an end has lost its state. Counters protect against old frames only while
/// both ends remember them; an end that has forgotten asks for a new epoch, whose name is made of a fresh
/// random number of each end. No frame of any earlier epoch passes in it, so neither end needs to remember
/// anything. Three hello frames, about 0.12 s at 9600 baud; both ends that kept their state need none.
///
/// Why an old hello does no harm: an end changes its epoch only for a hello that echoes its own random
/// number, and a number that has made an epoch never makes another. A replayed hello therefore costs an
/// answer (which the link limits in rate) and nothing else.
class EpochAgreement {
 public:
  /// The random numbers that an epoch is made of, one drawn by each end.
  struct Pair {
    std::uint64_t own = 0;
    std::uint64_t peer = 0;
  };
  /// What follows from a hello.
  struct Change {
    std::optional<Pair> agreed;  ///< change to the epoch of this pair now
    bool reply = false;          ///< send Compose() soon
  };

  explicit EpochAgreement(NonceSource nonces);

  Change OnHello(const Hello& hello);
  /// The next hello to send, table hash and stream left to the caller.
  Hello Compose(bool need) const;

 private:
  NonceSource nonces_;
  std::uint64_t own_;
  std::optional<std::uint64_t> peer_;
  bool agreed_ = false;
};

}  // namespace priamos::bus::radio
