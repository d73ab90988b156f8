#include "bus/log/log_writer.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace priamos::bus {

LogWriter::LogWriter(const std::string& path) : file_(path, std::ios::binary | std::ios::trunc) {
  if (!file_) throw std::runtime_error(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
}

void LogWriter::Write(std::int64_t utime, std::string_view channel, std::span<const std::byte> bytes) {
  if (scribe_)
    for (const auto& text : scribe_->TextsBefore(bytes, utime)) Write(next_number_++, utime, kTypeText, text);
  Write(next_number_++, utime, channel, bytes);
}

void LogWriter::WriteAsNumbered(const LogEvent& event) {
  Write(event.number, event.utime, event.channel, event.bytes);
  next_number_ = static_cast<std::int64_t>(static_cast<std::uint64_t>(event.number) + 1);
}

void LogWriter::Write(std::int64_t number, std::int64_t utime, std::string_view channel,
                      std::span<const std::byte> bytes) {
  std::string event;
  AppendEvent(event, number, utime, channel, bytes);
  file_.write(event.data(), static_cast<std::streamsize>(event.size()));
}

}  // namespace priamos::bus
