#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bus/clocks/repeated_messages.hpp"
#include "common/time.hpp"

namespace priamos::bus {

class Schema;

/// The time stamp of a message: its first field, by the rules of our types. nullopt for a message that has
/// none, or is none.
std::optional<Time> StampOf(const Schema& schema, std::span<const std::byte> bytes);

/// What tells a message from others: a hash of its channel and of all of it.
std::uint64_t IdentityOf(std::string_view channel, std::span<const std::byte> bytes);

/// The time of a log that is being played onto a bus, from the stamps of its messages: that of the newest
/// one. Pure.
///
/// A few wrong stamps do no harm: one that is more than kLeap ahead counts when kWitnesses in a row say so.
/// When kWitnessesBack in a row are more than kBack behind, or messages that were heard before come again
/// (RepeatedMessages), the log was started again, or sought back: then nothing further is taken. (Of the
/// recorded runs one message in a row is so far behind.)
class LogTime {
 public:
  static constexpr Duration kLeap{2'000'000}, kBack{2'000'000};
  static constexpr int kWitnesses = 3, kWitnessesBack = 20;

  /// Whether a log can be of that time: not before 1970, nor centuries ahead.
  static bool IsPlausible(Time stamp);
  /// Takes the stamp of the next message, and what tells it from others; nullopt: that is not known.
  void Hear(Time stamp, std::optional<std::uint64_t> identity = std::nullopt);

  /// Newest stamp that counts; nullopt before the first message.
  std::optional<Time> now() const { return now_; }
  /// Whether the last message may be one of a log that begins again: far behind, or heard before.
  bool is_behind() const { return behind_ > 0 || repeated_.is_repeating(); }
  bool went_back() const { return behind_ >= kWitnessesBack || repeated_.began_again(); }
  /// Messages so far that were more than kBack behind.
  std::uint64_t far_behind() const { return far_behind_; }

 private:
  bool IsWitnessed(Time stamp);

  std::optional<Time> now_;
  Time leap_{};        ///< where a leap would lead
  int witnesses_ = 0;  ///< stamps in a row near leap_
  int behind_ = 0;     ///< stamps in a row far behind now_
  std::uint64_t far_behind_ = 0;
  RepeatedMessages repeated_;
};

/// A message as it came over a bus.
struct HeardMessage {
  std::string channel;
  std::vector<std::byte> bytes;
};

/// The messages by which a LogTime notices that a log begins again. They belong to what comes after it. Pure.
class BeginningAgain {
 public:
  /// Takes a message whose stamp `time` has just heard.
  void Note(const LogTime& time, std::string_view channel, std::span<const std::byte> bytes);
  /// Hands out all messages since the first that was behind.
  std::vector<HeardMessage> Take();
  /// Number of messages that may begin a log again.
  std::size_t size() const { return messages_.size(); }

 private:
  std::vector<HeardMessage> messages_;
};

}  // namespace priamos::bus
