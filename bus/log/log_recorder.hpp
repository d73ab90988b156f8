#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bus/log/type_texts.hpp"
#include "common/time.hpp"

namespace priamos::bus {

/// How a recording is cut into files and what disk it may use.
struct RecorderLimits {
  std::uint64_t split_bytes = 0;  ///< begin another file after so many bytes; 0: never
  Duration split_time{};          ///< ... or after this time; 0: never
  std::size_t keep_files = 0;     ///< files of this recording; beyond them the oldest is deleted; 0: keep all
  std::uint64_t keep_free_bytes = 0;  ///< stop (after deleting old files, if allowed) before less is free
};

/// Records a bus into log files that every LCM tool reads. It never blocks for longer than a write, never
/// throws after the start, and a file always ends with a whole event: one that a full disk cut off is
/// removed. After a failure it reports why (alarm()), counts what it loses, looks once per second whether a
/// megabyte more than `keep_free_bytes` is free, and then tries again: with less the next file would end at
/// once.
///
/// `path` is the first file; files after it are called `path` with .1, .2 ... before the extension.
class LogRecorder {
 public:
  /// Begins recording into a new file. Throws std::runtime_error when the first file cannot be made.
  LogRecorder(const std::filesystem::path& path, const RecorderLimits& limits, Time now);
  ~LogRecorder();
  LogRecorder(const LogRecorder&) = delete;
  LogRecorder& operator=(const LogRecorder&) = delete;

  /// From now on each file defines a type before its first message. `schema` must outlive the recorder.
  void DefineTypesOf(const Schema& schema);
  void Add(Time now, std::string_view channel, std::span<const std::byte> bytes);
  /// Writes the buffer and checks the free space. Call it at least every 0.2 s, also while nothing arrives.
  void Tick(Time now);

  /// Why nothing is being recorded; empty while recording works.
  const std::string& alarm() const { return alarm_; }
  std::uint64_t recorded() const { return recorded_; }  ///< events in files
  std::uint64_t lost() const { return lost_; }          ///< events that did not get into a file
  /// Those of lost() that no log can hold, by their channel, time or size (IsWritable).
  std::uint64_t unwritable() const { return unwritable_; }
  std::uint64_t bytes() const { return total_bytes_; }  ///< in all files together
  const std::filesystem::path& file() const { return files_.empty() ? base_ : files_.back(); }

 private:
  bool Open(Time now);
  void Close();
  void Flush();
  void NoteWritten(std::size_t events, std::size_t bytes);
  void Fail(const std::string& what);
  bool DueForSplit(Time now) const;
  void Split(Time now);
  void Append(Time now, std::string_view channel, std::span<const std::byte> bytes);
  void Lose();
  void DeleteOldest();
  bool EnoughIsFree(std::uint64_t bytes) const;
  void WatchFreeSpace();
  std::filesystem::path NextPath();

  std::filesystem::path base_;
  RecorderLimits limits_;
  std::optional<TypeScribe> scribe_;
  std::deque<std::filesystem::path> files_;
  std::size_t file_count_ = 0;
  int fd_ = -1;
  std::uint64_t file_bytes_ = 0;         ///< whole events in the open file
  std::string buffer_;                   ///< whole events, not written yet
  std::vector<std::size_t> event_ends_;  ///< in buffer_
  Time opened_{}, next_flush_{}, next_check_{};
  std::string alarm_;
  std::int64_t next_number_ = 0;
  std::uint64_t recorded_ = 0, lost_ = 0, unwritable_ = 0, total_bytes_ = 0;
};

}  // namespace priamos::bus
