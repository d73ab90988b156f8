#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "common/time.hpp"
#include "console/core/browser_message.hpp"

namespace priamos::console {

/// Who is told what a log holds.
class LogListener {
 public:
  virtual ~LogListener() = default;
  /// A message of the log, at the log's own time.
  virtual void Heard(const std::string& channel, std::span<const std::byte> bytes, Time time) = 0;
  /// The log jumped: what was heard so far does not hold.
  virtual void Begun() = 0;
};

/// A log that the station shows, whoever plays it.
class ShownLog {
 public:
  virtual ~ShownLog() = default;
  /// Tells what is due at `now`, by this host's clock.
  virtual void Play(Time now, LogListener& listener) = 0;
  /// Does what a page asks for, as far as this end plays the log.
  virtual void Obey(const ReplayOrder& order, Time now, LogListener& listener) = 0;
  /// The log's own time: that from which ages count.
  virtual Time time() const = 0;
  /// What pages know of it: {"position_s", "speed", "paused"}.
  virtual nlohmann::ordered_json State() const = 0;
};

}  // namespace priamos::console
