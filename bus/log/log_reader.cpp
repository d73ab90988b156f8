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

/// What is given back at once: a multiple of every page, and so much that the calls cost nothing.
constexpr std::size_t kBlock = std::size_t{8} << 20;

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

/// True when an event begins between the two: magic and a plausible length are there.
bool LogReader::HoldsEvent(std::size_t begin, std::size_t end) const {
  for (std::size_t at = begin; at + 4 <= end; ++at)
    if (MagicAt(at) && EndOfEvent(at)) return true;
  return false;
}

std::size_t LogReader::EndOfEvent(std::size_t offset) const {
  if (bytes_.size() - offset < kHeaderBytes) return 0;
  for (const std::size_t at : {offset + 4, offset + 12}) {
    const auto number_or_utime = ReadBigEndian<std::int64_t>(&bytes_[at]);
    if (number_or_utime < -kLargestNumber || number_or_utime > kLargestNumber) return 0;
  }
  const auto channel_bytes = ReadBigEndian<std::uint32_t>(&bytes_[offset + 20]);
  const auto data_bytes = ReadBigEndian<std::uint32_t>(&bytes_[offset + 24]);
  if (channel_bytes == 0 || channel_bytes > kMaxChannelBytes || data_bytes > kMaxDataBytes) return 0;
  const std::size_t end = offset + kHeaderBytes + channel_bytes + data_bytes;
  if (end > bytes_.size()) return 0;
  const auto* name = reinterpret_cast<const char*>(&bytes_[offset + kHeaderBytes]);
  return IsLogChannel({name, channel_bytes}) ? end : 0;
}

std::optional<LogEvent> LogReader::ParseAt(std::size_t offset, std::size_t& end) const {
  if (!MagicAt(offset)) return std::nullopt;
  end = EndOfEvent(offset);
  if (end == 0) return std::nullopt;
  // A damaged length that still fits shows by swallowing the next event. (An event followed by something else
  // is whole: then the damage is in its successor. What only looks like a magic may be in any message.)
  if (!MagicAt(end) && HoldsEvent(offset + 4, end)) return std::nullopt;
  const std::byte* header = &bytes_[offset];
  const auto channel_bytes = ReadBigEndian<std::uint32_t>(header + 20);
  const auto* name = reinterpret_cast<const char*>(header + kHeaderBytes);
  const auto data =
      bytes_.subspan(offset + kHeaderBytes + channel_bytes, ReadBigEndian<std::uint32_t>(header + 24));
  LogEvent event;
  event.number = ReadBigEndian<std::int64_t>(header + 4);
  event.utime = ReadBigEndian<std::int64_t>(header + 12);
  event.channel.assign(name, channel_bytes);
  event.bytes.assign(data.begin(), data.end());
  event.offset = offset;
  return event;
}

void LogReader::Seek(std::size_t offset) {
  offset_ = offset;
  given_back_ = std::min(given_back_, offset / kBlock * kBlock);
}

/// Pages of the file that were read stay in the memory of the process until somebody needs the room. They are
/// read from the file again when the reader goes back.
void LogReader::GiveBack() {
  const std::size_t end = offset_ / kBlock * kBlock;
  if (!mapping_ || end <= given_back_) return;
  auto* memory = const_cast<std::byte*>(bytes_.data());
  madvise(memory + given_back_, end - given_back_, MADV_DONTNEED);  // refused: they stay, as they did before
  given_back_ = end;
}

std::optional<LogEvent> LogReader::Next() {
  for (bool skipping = false; offset_ < bytes_.size(); ++offset_, ++skipped_) {
    GiveBack();
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
