#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <iterator>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "common/time.hpp"
#include "lcmtypes/channel.hpp"

namespace priamos::bus {

/// Most messages of one channel that wait between two ticks.
inline constexpr std::size_t kInboxCapacity = 256;

/// What Add() displaced from a full queue.
enum class Displaced {
  kNothing,
  kRepeated,  ///< a message of a safety channel whose act a newer waiting message orders again
  kLost,      ///< the oldest message of any other channel
};

/// Messages of one channel that wait for the next tick, oldest first, at most kInboxCapacity.
///
/// A full queue loses its oldest message. A safety channel loses no act: of every act that was ordered since
/// the last tick the newest message is delivered, in the order of arrival. Memory is bounded all the same,
/// even under a flood of the safety channel, because a message orders one of at most 256 acts (`SafetyAct`):
/// of 257 messages two order the same act, and the older of two such messages makes room.
template <class T>
class InboxQueue {
 public:
  using Entry = std::pair<Time, T>;

  /// Empty queue. `act`: Channel::safety_act of the channel, null unless it is a safety channel.
  explicit InboxQueue(SafetyAct<T> act) : act_(act) {}

  std::size_t size() const { return entries_.size(); }

  Displaced Add(Time arrival, T message) {
    entries_.emplace_back(arrival, std::move(message));
    Count(entries_.back(), +1);
    if (entries_.size() <= kInboxCapacity) return Displaced::kNothing;
    auto displaced = entries_.begin();
    while (act_ && waiting_[IndexOf(*displaced)] == 1) ++displaced;
    Count(*displaced, -1);
    entries_.erase(displaced);
    return act_ ? Displaced::kRepeated : Displaced::kLost;
  }

  /// Messages that wait, each with its arrival by the receiver's own clock; nothing waits after.
  std::vector<Entry> TakeAll() {
    std::vector<Entry> all(std::make_move_iterator(entries_.begin()),
                           std::make_move_iterator(entries_.end()));
    entries_.clear();
    waiting_.fill(0);
    return all;
  }

 private:
  static constexpr std::size_t kActs = 1U << std::numeric_limits<std::uint8_t>::digits;
  static_assert(kInboxCapacity >= kActs, "a full queue must hold an act twice");

  std::size_t IndexOf(const Entry& entry) const { return static_cast<std::uint8_t>(act_(entry.second)); }
  void Count(const Entry& entry, int change) {
    if (act_) waiting_[IndexOf(entry)] += change;
  }

  SafetyAct<T> act_;
  std::deque<Entry> entries_;
  std::array<int, kActs> waiting_{};  ///< messages in the queue per act; of a safety channel only
};

/// Every message of an event channel that arrived since the last call, oldest first.
template <class T>
class Inbox {
 public:
  explicit Inbox(std::shared_ptr<InboxQueue<T>> queue) : queue_(std::move(queue)) {}

  std::vector<T> Drain() {
    std::vector<T> all;
    for (auto& [arrival, message] : queue_->TakeAll()) all.push_back(std::move(message));
    return all;
  }
  /// Each with its arrival, by the receiver's own clock.
  std::vector<std::pair<Time, T>> DrainWithArrival() { return queue_->TakeAll(); }

 private:
  std::shared_ptr<InboxQueue<T>> queue_;
};

}  // namespace priamos::bus
