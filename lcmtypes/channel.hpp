#pragma once

#include <chrono>
#include <string_view>

namespace priamos {

/// One channel: the only place where its name, type, rate and life span are written.
template <class T>
struct Channel {
  using Message = T;
  std::string_view name;                    ///< from `[A-Z0-9_]`: LCM reads names as regular expressions
  double rate_hz = 0;                       ///< nominal rate; 0 for events, which come when something happens
  std::chrono::milliseconds stale_after{};  ///< a state older than this is not to be acted on; 0 for events
};

}  // namespace priamos
