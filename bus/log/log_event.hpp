#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace priamos::bus {

/// One message of a log.
struct LogEvent {
  std::int64_t number = 0;  ///< counted by the recorder, from 0
  std::int64_t utime = 0;   ///< [us] time of recording
  std::string channel;
  std::vector<std::byte> bytes;
  std::size_t offset = 0;  ///< where it begins in the file; set by LogReader
};

/// LCM's log format, big endian: magic 4, number 8, time 8, channel length 4, data length 4, channel, data.
namespace log_format {
inline constexpr std::uint32_t kMagic = 0xEDA1DA01;
inline constexpr std::size_t kHeaderBytes = 28;
}  // namespace log_format

/// True for a name that may stand in a log: 1 to 255 printable ASCII characters. Anything else in its place
/// is taken for damage by readers.
bool IsLogChannel(std::string_view name);

/// Appends one event in LCM's log format.
void AppendEvent(std::string& out, std::int64_t number, std::int64_t utime, std::string_view channel,
                 std::span<const std::byte> bytes);

}  // namespace priamos::bus
