#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "bus/log/log_reader.hpp"

namespace priamos::bus {

class Schema;

/// Contents and losses of a log.
struct LogSurvey {
  /// Contents of one channel; times as in the log, since 1970 [us].
  struct Channel {
    std::set<std::string> types;  ///< full names; "?" for a fingerprint nobody knows
    std::uint64_t events = 0;
    std::uint64_t bytes = 0;        ///< encoded size of all messages
    std::uint64_t undecodable = 0;  ///< refused by the schema walk, or of unknown type
    std::int64_t first_utime = 0, last_utime = 0;
    /// Mean rate over the channel's own time; 0 for a single event.
    double RateHz() const;
  };
  std::map<std::string, Channel> channels;
  std::uint64_t events = 0;
  std::int64_t first_utime = 0, last_utime = 0;  ///< earliest and latest time of recording [us]
  std::uint64_t size_bytes = 0;
  std::uint64_t skipped_bytes = 0;
  std::uint64_t damaged_places = 0;
  std::optional<LogReader::Damage> first_damage;
  std::uint64_t missing_numbers = 0;  ///< events the recorder counted that are not in the file
  std::uint64_t undecodable = 0;

  bool whole() const { return skipped_bytes == 0 && missing_numbers == 0; }
};

/// Reads the whole log; it may define types that `schema` has not.
LogSurvey Survey(LogReader& reader, const Schema& schema);

}  // namespace priamos::bus
