#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "common/time.hpp"

namespace priamos::bus {

class Schema;

/// The time stamp of a message: its first field, by the rules of our types. nullopt for a message that has
/// none, or is none.
std::optional<Time> StampOf(const Schema& schema, std::span<const std::byte> bytes);

/// The time of a log that is being played onto a bus, from the stamps of its messages: that of the newest
/// one. Pure.
///
/// A few wrong stamps do no harm: one that is more than kLeap ahead counts when kWitnesses in a row say so.
/// When kWitnessesBack in a row are more than kBack behind, the log was started again, or sought back.
class LogTime {
 public:
  static constexpr Duration kLeap{2'000'000}, kBack{5'000'000};
  static constexpr int kWitnesses = 3, kWitnessesBack = 50;

  /// Takes the stamp of the next message.
  void Hear(Time stamp);

  /// Newest stamp that counts; nullopt before the first message.
  std::optional<Time> now() const { return now_; }
  bool went_back() const { return behind_ >= kWitnessesBack; }

 private:
  bool IsWitnessed(Time stamp);

  std::optional<Time> now_;
  Time leap_{};        ///< where a leap would lead
  int witnesses_ = 0;  ///< stamps in a row near leap_
  int behind_ = 0;     ///< stamps in a row far behind now_
};

}  // namespace priamos::bus
