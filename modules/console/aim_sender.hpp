#pragma once

#include <optional>

#include "common/time.hpp"
#include "priamos/head_aim_t.hpp"

namespace priamos::console {

/// An aim is said three times, since the radio may lose it and the head does not answer: the head takes a
/// repetition for the same, and obeys none that is older than 3 s.
class AimSender {
 public:
  void Give(const head_aim_t& aim) {
    aim_ = aim;
    left_ = kTimes;
    sent_.reset();
  }
  /// The aim when it is time to send it.
  std::optional<head_aim_t> Step(Time now) {
    if (left_ == 0 || (sent_ && now - *sent_ < kAgain)) return std::nullopt;
    --left_;
    sent_ = now;
    return aim_;
  }

 private:
  static constexpr int kTimes = 3;
  static constexpr Duration kAgain = std::chrono::milliseconds(600);

  head_aim_t aim_{};
  int left_ = 0;
  std::optional<Time> sent_;
};

}  // namespace priamos::console
