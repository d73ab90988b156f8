#include "bus/log/log_reader.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "bus/schema/big_endian.hpp"

namespace priamos::bus {
namespace {

using log_format::kHeaderBytes;
using log_format::kMagic;

[[noreturn]] void CannotRead(const std::string& path, int error) {
  throw std::runtime_error(fmt::format("{}: cannot be read: {}", path, std::strerror(error)));
}

struct Descriptor {
  int fd;
  ~Descriptor() { close(fd); }
};

/// The mapped file; null for an empty one, which cannot be mapped.
std::shared_ptr<const void> Map(const std::string& path, std::size_t& size) {
  const Descriptor file{open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  if (file.fd < 0) CannotRead(path, errno);
  struct stat status {};
  if (fstat(file.fd, &status) != 0) CannotRead(path, errno);
  if (!S_ISREG(status.st_mode)) CannotRead(path, S_ISDIR(status.st_mode) ? EISDIR : EINVAL);
  size = static_cast<std::size_t>(status.st_size);
  if (size == 0) return nullptr;
  void* memory = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.fd, 0);
  if (memory == MAP_FAILED) CannotRead(path, errno);
  return {memory, [size](void* mapped) { munmap(mapped, size); }};
}

}  // namespace

LogReader::LogReader(const std::string& path) {
  std::size_t size = 0;
  mapping_ = Map(path, size);
  bytes_ = {static_cast<const std::byte*>(mapping_.get()), size};
}

bool LogReader::MagicAt(std::size_t offset) const {
  return offset + 4 <= bytes_.size() && ReadBigEndian<std::uint32_t>(&bytes_[offset]) == kMagic;
}

bool LogReader::FindMagic(std::size_t begin, std::size_t end) const {
  for (std::size_t at = begin; at + 4 <= end; ++at)
    if (MagicAt(at)) return true;
  return false;
}

std::optional<LogEvent> LogReader::ParseAt(std::size_t offset, std::size_t& end) const {
  if (bytes_.size() - offset < kHeaderBytes || !MagicAt(offset)) return std::nullopt;
  const std::byte* header = &bytes_[offset];
  const auto channel_bytes = ReadBigEndian<std::uint32_t>(header + 20);
  const auto data_bytes = ReadBigEndian<std::uint32_t>(header + 24);
  if (channel_bytes == 0 || channel_bytes > kMaxChannelBytes || data_bytes > kMaxDataBytes)
    return std::nullopt;
  end = offset + kHeaderBytes + channel_bytes + data_bytes;
  if (end > bytes_.size()) return std::nullopt;
  // A damaged length that still fits shows by swallowing the next event's magic. (An event followed by
  // something else is whole: then the damage is in its successor.)
  if (!MagicAt(end) && FindMagic(offset + 4, end)) return std::nullopt;
  const auto channel = bytes_.subspan(offset + kHeaderBytes, channel_bytes);
  const std::string_view name(reinterpret_cast<const char*>(channel.data()), channel.size());
  if (!IsLogChannel(name)) return std::nullopt;
  const auto data = bytes_.subspan(end - data_bytes, data_bytes);
  LogEvent event;
  event.number = ReadBigEndian<std::int64_t>(header + 4);
  event.utime = ReadBigEndian<std::int64_t>(header + 12);
  event.channel = name;
  event.bytes.assign(data.begin(), data.end());
  event.offset = offset;
  return event;
}

std::optional<LogEvent> LogReader::Next() {
  for (bool skipping = false; offset_ < bytes_.size(); ++offset_, ++skipped_) {
    std::size_t end = 0;
    if (auto event = ParseAt(offset_, end)) {
      offset_ = end;
      return event;
    }
    if (!skipping) ++damaged_places_;
    skipping = true;
  }
  return std::nullopt;
}

}  // namespace priamos::bus
