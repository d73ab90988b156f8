#pragma once

#include <fstream>
#include <optional>

#include "bus/log/log_event.hpp"
#include "bus/log/type_texts.hpp"

namespace priamos::bus {

/// Writes LCM's log format; every LCM tool reads it. For recording a live bus there is LogRecorder.
class LogWriter {
 public:
  /// Creates the log file `path`. Throws std::runtime_error when it cannot be made.
  explicit LogWriter(const std::string& path);
  /// From now on a type is defined before its first message. `schema` must outlive the writer.
  void DefineTypesOf(const Schema& schema) {
    scribe_.emplace([&schema](std::span<const std::byte> bytes) { return schema.Of(bytes); });
  }
  /// Writes the next event; they are numbered from 0.
  void Write(std::int64_t utime, std::string_view channel, std::span<const std::byte> bytes);
  /// Writes an event with the number that it has.
  void WriteAsNumbered(const LogEvent& event);
  /// Puts everything written so far where a reader sees it.
  void Flush() { file_.flush(); }
  /// Whether every write has succeeded so far; a full disk is one reason for false.
  bool good() const { return file_.good(); }

 private:
  void Write(std::int64_t number, std::int64_t utime, std::string_view channel,
             std::span<const std::byte> bytes);

  std::ofstream file_;
  std::optional<TypeScribe> scribe_;
  std::int64_t next_number_ = 0;
};

}  // namespace priamos::bus
