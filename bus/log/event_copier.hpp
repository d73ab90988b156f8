#pragma once

#include "bus/log/log_writer.hpp"
#include "bus/log/type_texts.hpp"

namespace priamos::bus {

/// Copies chosen events of logs into another one. Definitions of types are written anew before what needs
/// them, so that they are there whatever was chosen.
class EventCopier {
 public:
  /// `writer` must outlive it.
  explicit EventCopier(LogWriter& writer) : writer_(writer) {}

  /// True for an event that defines a type: it is kept until it is needed.
  bool Keep(std::span<const std::byte> bytes) { return types_.Take(bytes); }
  void Write(std::int64_t utime, std::string_view channel, std::span<const std::byte> bytes) {
    for (const auto& text : scribe_.TextsBefore(bytes, utime)) writer_.Write(utime, kTypeText, text);
    writer_.Write(utime, channel, bytes);
  }

 private:
  LogWriter& writer_;
  LogTypes types_{nullptr};
  TypeScribe scribe_{[this](std::span<const std::byte> bytes) { return types_.Of(bytes); }};
};

}  // namespace priamos::bus
