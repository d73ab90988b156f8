#include "bus/log/log_event.hpp"

#include <algorithm>

namespace priamos::bus {
namespace {

template <class T>
void AppendBig(std::string& out, T value) {
  for (int shift = 8 * (sizeof(T) - 1); shift >= 0; shift -= 8)
    out.push_back(static_cast<char>(value >> shift & 0xff));
}

}  // namespace

bool IsLogChannel(std::string_view name) {
  return !name.empty() && name.size() <= log_format::kMostChannelBytes &&
         std::all_of(name.begin(), name.end(), [](char c) { return c >= 0x20 && c < 0x7f; });
}

std::string_view ProblemOf(std::int64_t utime, std::string_view channel, std::size_t data_bytes) {
  if (utime < -log_format::kLargestTime || utime > log_format::kLargestTime)
    return "a time beyond the year 2255";
  if (channel.empty()) return "a channel without a name";
  if (channel.size() > log_format::kMostChannelBytes) return "a channel with a name of more than 255 bytes";
  if (!IsLogChannel(channel)) return "a channel with a name that is not printable ASCII";
  return data_bytes > log_format::kMostDataBytes ? "a message of more than 64 MB" : "";
}

void AppendEvent(std::string& out, std::int64_t number, std::int64_t utime, std::string_view channel,
                 std::span<const std::byte> bytes) {
  out.reserve(out.size() + log_format::kHeaderBytes + channel.size() + bytes.size());
  AppendBig<std::uint32_t>(out, log_format::kMagic);
  AppendBig<std::uint64_t>(out, static_cast<std::uint64_t>(number));
  AppendBig<std::uint64_t>(out, static_cast<std::uint64_t>(utime));
  AppendBig<std::uint32_t>(out, static_cast<std::uint32_t>(channel.size()));
  AppendBig<std::uint32_t>(out, static_cast<std::uint32_t>(bytes.size()));
  out.append(channel);
  out.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

}  // namespace priamos::bus
