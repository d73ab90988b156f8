#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <set>
#include <unordered_map>

#include "common/time.hpp"

namespace priamos::bus {

/// Notices that a log is played again from the messages themselves: bytes that were heard before come once
/// more, with the stamps that they had, while nothing goes on. So a log of any length tells it, also one that
/// is started again in its first second. Pure.
///
/// A genuine log repeats messages as well (an order that is said again, a block that is sent again), but
/// those have a stamp or two, and newer messages come between them.
class RepeatedMessages {
 public:
  /// Stamps of repeated messages that tell it; of a log that has fewer, all of them, and at least kFewest.
  static constexpr std::size_t kStamps = 10, kFewest = 2;
  /// Messages that are remembered. Of a log with more, those that come again are old enough to tell it.
  static constexpr std::size_t kKept = 4096;
  /// New messages with old stamps among repeated ones, as when one was lost the first time; more end the run.
  static constexpr int kMostNew = 20;

  /// Takes the next message: a hash of all that it is, its stamp, and the newest stamp before it.
  void Hear(std::uint64_t message, Time stamp, Time newest);
  /// Whether the last messages may be those of a log that begins again.
  bool is_repeating() const { return !repeated_.empty(); }
  bool began_again() const;

 private:
  /// Remembers the message; false when it was known.
  bool Remember(std::uint64_t message);
  void EndRun();

  std::deque<std::uint64_t> order_;  ///< of what is remembered, the oldest first
  std::unordered_map<std::uint64_t, int> times_;
  std::set<Time> stamps_;    ///< that were heard, kStamps at most
  std::set<Time> repeated_;  ///< stamps of the present run of repeated messages
  int new_ = 0;              ///< new messages in that run
};

}  // namespace priamos::bus
