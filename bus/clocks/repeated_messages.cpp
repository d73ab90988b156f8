#include "bus/clocks/repeated_messages.hpp"

#include <algorithm>

namespace priamos::bus {

void RepeatedMessages::Hear(std::uint64_t message, Time stamp, Time newest) {
  const bool known = !Remember(message);
  if (stamps_.size() < kStamps) stamps_.insert(stamp);
  if (stamp > newest) return EndRun();
  if (known)
    repeated_.insert(stamp);
  else if (is_repeating() && ++new_ > kMostNew)
    EndRun();
}

bool RepeatedMessages::began_again() const {
  return repeated_.size() >= std::max(kFewest, stamps_.size());
}

bool RepeatedMessages::Remember(std::uint64_t message) {
  const bool is_new = ++times_[message] == 1;
  order_.push_back(message);
  if (order_.size() > kKept) {
    if (--times_[order_.front()] == 0) times_.erase(order_.front());
    order_.pop_front();
  }
  return is_new;
}

void RepeatedMessages::EndRun() {
  repeated_.clear();
  new_ = 0;
}

}  // namespace priamos::bus
