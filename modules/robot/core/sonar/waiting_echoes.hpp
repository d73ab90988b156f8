#pragma once

#include <cstddef>
#include <deque>

#include "common/time.hpp"
#include "robot/core/sonar/placed_echo.hpp"

namespace priamos::robot {

/// How long an echo waits for what explains it.
struct WaitingLimits {
  double window_m = 0;   ///< until the base has driven so far ...
  double window_s = 0;   ///< ... or for this time
  std::size_t most = 0;  ///< echoes; of more the oldest go first
};

/// Echoes that nothing explains yet, oldest first, each with its vote for what may explain it (Votes: Add and
/// Remove of a PlacedEcho). A vote goes with its echo.
template <class Votes>
class WaitingEchoes {
 public:
  explicit WaitingEchoes(const WaitingLimits& limits) : limits_(limits) {}

  void Add(const PlacedEcho& echo, Time time) {
    waiting_.push_back({time, echo});
    votes_.Add(echo);
  }
  /// Drops what has waited for too long, when the base has driven `travel_m` in all.
  void Forget(Time now, double travel_m) {
    while (!waiting_.empty() && IsOver(waiting_.front(), now, travel_m)) {
      votes_.Remove(waiting_.front().echo);
      waiting_.pop_front();
    }
  }
  /// Drops what is explained by now.
  template <class Explains>
  void Release(const Explains& explains) {
    std::erase_if(waiting_, [&](const Waiting& waiting) {
      if (!explains(waiting.echo)) return false;
      votes_.Remove(waiting.echo);
      return true;
    });
  }

  const Votes& votes() const { return votes_; }
  std::size_t size() const { return waiting_.size(); }
  /// Calls visit(echo, its index), oldest first: much faster than by index.
  template <class Visit>
  void ForEach(const Visit& visit) const {
    std::size_t index = 0;
    for (const Waiting& waiting : waiting_) visit(waiting.echo, index++);
  }
  const PlacedEcho& operator[](std::size_t i) const { return waiting_[i].echo; }

 private:
  struct Waiting {
    Time time{};
    PlacedEcho echo;
  };
  bool IsOver(const Waiting& waiting, Time now, double travel_m) const {
    return waiting_.size() > limits_.most || travel_m - waiting.echo.travel_m > limits_.window_m ||
           now - waiting.time > FromSeconds(limits_.window_s);
  }

  WaitingLimits limits_;
  Votes votes_;
  std::deque<Waiting> waiting_;
};

}  // namespace priamos::robot
