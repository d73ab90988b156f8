#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

namespace priamos {

/// What a message of a safety channel orders: one of at most 256 acts. Two messages of one act order the
/// same, so that a receiver who is flooded may keep the newest of each act and loses no order.
template <class T>
using SafetyAct = std::int8_t (*)(const T&);

/// One channel: the only place where its name, type, rate and life span are written.
template <class T>
struct Channel {
  using Message = T;
  std::string_view name;                    ///< from `[A-Z0-9_]`: LCM reads names as regular expressions
  double rate_hz = 0;                       ///< nominal rate; 0 for events, which come when something happens
  std::chrono::milliseconds stale_after{};  ///< a state older than this is not to be acted on; 0 for events
  SafetyAct<T> safety_act = nullptr;        ///< marks a safety channel: no act of it is ever dropped
};

}  // namespace priamos
