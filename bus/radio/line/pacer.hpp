#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "common/time.hpp"

namespace priamos::bus::radio {

/// Computes, from the time on the wire, when the line has sent the bytes given to it. A tty's buffer would
/// take bytes for seconds and then send an emergency stop behind all of them.
class Pacer {
 public:
  Pacer(double bytes_per_s, int ahead_bytes, Time start)
      : byte_ns_(static_cast<std::int64_t>(std::ceil(1e9 / bytes_per_s))),
        ahead_ns_(byte_ns_ * ahead_bytes),
        // As after a long silence: a frame that another process left half sent must not spoil the first.
        free_at_ns_(ToUtime(start - std::chrono::seconds(1)) * 1000) {}

  bool Allows(Time now) const { return free_at_ns_ <= ToUtime(now) * 1000 + ahead_ns_; }
  void Use(Time now) { free_at_ns_ = std::max(free_at_ns_, ToUtime(now) * 1000) + byte_ns_; }
  /// Time that `bytes` take on the wire.
  Duration WireTime(std::size_t bytes) const {
    return Duration(byte_ns_ * static_cast<std::int64_t>(bytes) / 1000);
  }
  /// Time at which `bytes` more will have left if they are written from `now` on.
  Time LeavesAt(std::size_t bytes, Time now) const { return std::max(free_at(), now) + WireTime(bytes); }
  Time free_at() const { return Time(Duration(free_at_ns_ / 1000)); }
  /// Time since the last byte left.
  Duration Idle(Time now) const { return std::max(now - free_at(), Duration::zero()); }

 private:
  std::int64_t byte_ns_;
  std::int64_t ahead_ns_;
  std::int64_t free_at_ns_;
};

}  // namespace priamos::bus::radio
