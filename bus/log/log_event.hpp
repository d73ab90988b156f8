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
inline constexpr std::size_t kMostChannelBytes = 255;
/// Largest message: what fragments on a bus can carry. A larger one is damage.
inline constexpr std::size_t kMostDataBytes = 64 << 20;
/// Largest time of an event [us] (the year 2255); a larger one is damage. Sums of such times do not overflow.
inline constexpr std::int64_t kLargestTime = std::int64_t{1} << 53;
}  // namespace log_format

/// True for a name that may stand in a log: 1 to 255 printable ASCII characters.
bool IsLogChannel(std::string_view name);

/// What readers take for damage in an event with these values, in words for `got ...`; empty: nothing.
std::string_view ProblemOf(std::int64_t utime, std::string_view channel, std::size_t data_bytes);

/// Whether every reader takes an event with these values.
inline bool IsWritable(std::int64_t utime, std::string_view channel, std::size_t data_bytes) {
  return ProblemOf(utime, channel, data_bytes).empty();
}

/// Appends one event in LCM's log format.
void AppendEvent(std::string& out, std::int64_t number, std::int64_t utime, std::string_view channel,
                 std::span<const std::byte> bytes);

}  // namespace priamos::bus
