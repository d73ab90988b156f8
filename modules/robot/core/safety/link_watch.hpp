#pragma once

#include <algorithm>
#include <optional>

#include "common/time.hpp"

namespace priamos::robot {

/// How long the radio link to the operator has been down.
class LinkWatch {
 public:
  /// The link as it is at `now`.
  void Update(bool down, Time now) {
    if (!down) down_since_.reset();
    if (down && !down_since_) down_since_ = now;
  }
  /// Time since the link went down: at least 1 us, so that it is never 0 while it is down; 0 while it is up.
  Duration DownFor(Time now) const {
    return down_since_ ? std::max(now - *down_since_, Duration(1)) : Duration::zero();
  }

 private:
  std::optional<Time> down_since_;
};

}  // namespace priamos::robot
