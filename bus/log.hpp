#pragma once

#include <cstdint>
#include <fstream>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace priamos::bus {

/// One message of a log.
struct LogEvent {
  std::int64_t number = 0;
  std::int64_t utime = 0;  ///< [us] time of recording
  std::string channel;
  std::vector<std::byte> bytes;
};

/// Writes LCM's log format; every LCM tool reads it.
class LogWriter {
 public:
  /// Throws std::runtime_error when the file cannot be made.
  explicit LogWriter(const std::string& path);
  void Write(std::int64_t utime, std::string_view channel, std::span<const std::byte> bytes);
  /// Puts everything written so far where a reader sees it.
  void Flush() { file_.flush(); }
  /// False once a write failed, e.g. on a full disk.
  bool good() const { return file_.good(); }

 private:
  std::ofstream file_;
  std::int64_t next_number_ = 0;
};

/// Reads LCM's log format. Damage does not end the reading: the reader goes on at the next credible event
/// and counts what it skipped.
class LogReader {
 public:
  static constexpr std::size_t kMaxChannelBytes = 255;
  static constexpr std::size_t kMaxDataBytes = 1 << 24;

  /// Throws std::runtime_error when the file cannot be read.
  explicit LogReader(const std::string& path);
  /// From bytes in memory.
  explicit LogReader(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {}

  /// The next whole event, or nullopt at the end.
  std::optional<LogEvent> Next();
  std::uint64_t skipped_bytes() const { return skipped_; }

 private:
  std::optional<LogEvent> ParseAt(std::size_t offset, std::size_t& end) const;
  bool MagicAt(std::size_t offset) const;
  bool FindMagic(std::size_t begin, std::size_t end) const;

  std::vector<std::byte> bytes_;
  std::size_t offset_ = 0;
  std::uint64_t skipped_ = 0;
};

}  // namespace priamos::bus
