#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "bus/log/log_reader.hpp"
#include "bus/log/log_writer.hpp"
#include "bus/node.hpp"

namespace priamos::cli {

/// A log that a test writes message by message, and that a verb reads as a log or hears as a bus.
class MessageLog {
 public:
  explicit MessageLog(const std::string& file) : file_(file), writer_(file) {}

  /// At `t_s` after the log's first second; the message's own stamp is the same.
  template <class T>
  MessageLog& Add(double t_s, std::string_view channel, T message) {
    message.utime = UtimeAt(t_s);
    return AddBytes(t_s, channel, bus::Encode(message));
  }
  MessageLog& AddBytes(double t_s, std::string_view channel, const std::vector<std::byte>& bytes) {
    writer_.Write(UtimeAt(t_s), channel, bytes);
    writer_.Flush();
    return *this;
  }

  static std::int64_t UtimeAt(double t_s) { return 1'000'000'000 + std::llround(t_s * 1e6); }
  const std::string& file() const { return file_; }
  /// For --bus: everything at once.
  std::string url() const { return "file://" + file_ + "?speed=0"; }

 private:
  std::string file_;
  bus::LogWriter writer_;
};

/// For --bus: what is sent there is written into `file`.
inline std::string SinkUrl(const std::string& file) {
  return "file://" + file + "?mode=w";
}

/// Every whole event of a log.
inline std::vector<bus::LogEvent> EventsOf(const std::string& file) {
  std::vector<bus::LogEvent> events;
  for (bus::LogReader reader(file); const auto event = reader.Next();) events.push_back(*event);
  return events;
}

}  // namespace priamos::cli
