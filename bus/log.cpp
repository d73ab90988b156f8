#include "bus/log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>

namespace priamos::bus {
namespace {

constexpr std::uint32_t kMagic = 0xEDA1DA01;
constexpr std::size_t kHeaderBytes =
    28;  // magic 4, number 8, time 8, channel length 4, data length 4; big-endian

template <class T>
T ReadBig(std::span<const std::byte> at) {
  T value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) value = static_cast<T>(value << 8 | std::to_integer<T>(at[i]));
  return value;
}

template <class T>
void AppendBig(std::string& out, T value) {
  for (int shift = 8 * (sizeof(T) - 1); shift >= 0; shift -= 8)
    out.push_back(static_cast<char>(value >> shift & 0xff));
}

bool CredibleChannel(std::span<const std::byte> name) {
  return std::all_of(name.begin(), name.end(), [](std::byte b) {
    const auto c = std::to_integer<unsigned char>(b);
    return c >= 0x20 && c < 0x7f;
  });
}

}  // namespace

LogWriter::LogWriter(const std::string& path) : file_(path, std::ios::binary | std::ios::trunc) {
  if (!file_) throw std::runtime_error(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
}

void LogWriter::Write(std::int64_t utime, std::string_view channel, std::span<const std::byte> bytes) {
  std::string event;
  event.reserve(kHeaderBytes + channel.size() + bytes.size());
  AppendBig<std::uint32_t>(event, kMagic);
  AppendBig<std::uint64_t>(event, static_cast<std::uint64_t>(next_number_++));
  AppendBig<std::uint64_t>(event, static_cast<std::uint64_t>(utime));
  AppendBig<std::uint32_t>(event, static_cast<std::uint32_t>(channel.size()));
  AppendBig<std::uint32_t>(event, static_cast<std::uint32_t>(bytes.size()));
  event.append(channel);
  event.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  file_.write(event.data(), static_cast<std::streamsize>(event.size()));
}

LogReader::LogReader(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
  std::vector<char> chars(std::istreambuf_iterator<char>(file), {});
  bytes_.resize(chars.size());
  std::memcpy(bytes_.data(), chars.data(), chars.size());
}

bool LogReader::MagicAt(std::size_t offset) const {
  return offset + 4 <= bytes_.size() &&
         ReadBig<std::uint32_t>(std::span(bytes_).subspan(offset, 4)) == kMagic;
}

bool LogReader::FindMagic(std::size_t begin, std::size_t end) const {
  for (std::size_t at = begin; at + 4 <= end; ++at)
    if (MagicAt(at)) return true;
  return false;
}

std::optional<LogEvent> LogReader::ParseAt(std::size_t offset, std::size_t& end) const {
  if (bytes_.size() - offset < kHeaderBytes) return std::nullopt;
  const auto header = std::span(bytes_).subspan(offset, kHeaderBytes);
  if (ReadBig<std::uint32_t>(header) != kMagic) return std::nullopt;
  const auto channel_bytes = ReadBig<std::uint32_t>(header.subspan(20));
  const auto data_bytes = ReadBig<std::uint32_t>(header.subspan(24));
  if (channel_bytes == 0 || channel_bytes > kMaxChannelBytes || data_bytes > kMaxDataBytes)
    return std::nullopt;
  end = offset + kHeaderBytes + channel_bytes + data_bytes;
  if (end > bytes_.size()) return std::nullopt;
  // A damaged length that still fits shows by swallowing the next event's magic. (An event followed by
  // something else is whole: then the damage is in its successor.)
  if (!MagicAt(end) && FindMagic(offset + 4, end)) return std::nullopt;
  const auto channel = std::span(bytes_).subspan(offset + kHeaderBytes, channel_bytes);
  if (!CredibleChannel(channel)) return std::nullopt;
  LogEvent event;
  event.number = static_cast<std::int64_t>(ReadBig<std::uint64_t>(header.subspan(4)));
  event.utime = static_cast<std::int64_t>(ReadBig<std::uint64_t>(header.subspan(12)));
  event.channel.assign(reinterpret_cast<const char*>(channel.data()), channel.size());
  event.bytes.assign(bytes_.begin() + static_cast<std::ptrdiff_t>(end - data_bytes),
                     bytes_.begin() + static_cast<std::ptrdiff_t>(end));
  return event;
}

std::optional<LogEvent> LogReader::Next() {
  for (; offset_ < bytes_.size(); ++offset_, ++skipped_) {
    std::size_t end = 0;
    if (auto event = ParseAt(offset_, end)) {
      offset_ = end;
      return event;
    }
  }
  return std::nullopt;
}

}  // namespace priamos::bus
