#include "bus/log/log_reader.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "bus/schema/big_endian.hpp"
#include "common/input/regular_file.hpp"

namespace priamos::bus {
namespace {

using log_format::kHeaderBytes;
using log_format::kMagic;

/// What is given back at once: a multiple of every page, and so much that the calls cost nothing.
constexpr std::size_t kBlock = std::size_t{8} << 20;

[[noreturn]] void CannotRead(const std::string& path, int error) {
  throw std::runtime_error(fmt::format("{}: cannot be read: {}", path, std::strerror(error)));
}

/// Files of /proc and /sys say that they are empty, and hold something, or cannot be read.
void RequireEmpty(const RegularFile& file, const std::string& path) {
  std::byte first{};
  const ssize_t n = pread(file.fd(), &first, 1, 0);
  if (n == 0) return;
  throw std::runtime_error(fmt::format(
      "{}: expected a log, got a file without a length, as the kernel makes up in /proc and /sys", path));
}

/// The mapped file; null for an empty one, which cannot be mapped.
std::shared_ptr<const void> Map(const std::string& path, std::size_t& size) {
  const RegularFile file(path);
  if (!file.open()) throw std::runtime_error(fmt::format("{}: expected a log, got {}", path, file.problem()));
  struct stat status {};
  if (fstat(file.fd(), &status) != 0) CannotRead(path, errno);
  size = static_cast<std::size_t>(status.st_size);
  if (size == 0) {
    RequireEmpty(file, path);
    return nullptr;
  }
  void* memory = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.fd(), 0);
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

/// Where in [begin, end) the events go on that an event with a wrong length, or a torn one, seems to hold: at
/// an event that another magic or the end of the file follows. An event in the middle of other data, as a
/// message may carry one, is no such place. Before the end of the file it must have the next number: the file
/// may have been cut behind an event in a message as well. Returns `end` when there is none.
std::size_t LogReader::FindFollower(std::size_t begin, std::size_t end, std::int64_t number) const {
  const auto next_number = static_cast<std::int64_t>(static_cast<std::uint64_t>(number) + 1);
  for (std::size_t at = begin; at < end; ++at) {
    const std::size_t behind = MagicAt(at) ? EndOfEvent(at).value_or(0) : 0;
    if (behind == 0 || behind > bytes_.size()) continue;
    const bool last = behind == bytes_.size() && NumberAt(at) == next_number;
    if (last || MagicAt(behind)) return at;
  }
  return end;
}

/// Where the events begin that the one at `offset` has swallowed, because a damaged length ends it at a later
/// one; nullopt: it has not. It is told by the numbers: those of the swallowed events are what is left out
/// before the event at `end`, and they fill it to the end. A message that carries events is not mistaken: in
/// front of the next number nothing is left out.
LogReader::Search LogReader::FindSwallowed(std::size_t offset, std::size_t end) const {
  if (end + kHeaderBytes > bytes_.size()) return {};
  const auto number = static_cast<std::uint64_t>(NumberAt(offset));
  const std::uint64_t ahead = static_cast<std::uint64_t>(NumberAt(end)) - number;
  if (ahead < 2 || ahead > end - offset) return {};
  const auto is_next = [&](std::size_t at, std::uint64_t after) {
    return MagicAt(at) && at + kHeaderBytes <= end && static_cast<std::uint64_t>(NumberAt(at)) == after + 1 &&
           EndOfEvent(at).value_or(end + 1) <= end;
  };
  Search search;
  std::size_t first = offset + kHeaderBytes + ReadBigEndian<std::uint32_t>(&bytes_[offset + 20]);
  for (; first < end && !is_next(first, number); ++first) ++search.looked_at;
  std::uint64_t last = number;
  std::size_t at = first;
  for (; at < end && is_next(at, last); ++last, ++search.looked_at) at = *EndOfEvent(at);
  const bool fills = first < end && at == end && static_cast<std::uint64_t>(NumberAt(end)) == last + 1;
  if (fills) search.found = first;
  return search;
}

std::int64_t LogReader::NumberAt(std::size_t offset) const {
  return ReadBigEndian<std::int64_t>(&bytes_[offset + 4]);
}

std::optional<std::size_t> LogReader::EndOfEvent(std::size_t offset) const {
  if (!ProblemAt(offset).empty()) return std::nullopt;
  return offset + kHeaderBytes + ReadBigEndian<std::uint32_t>(&bytes_[offset + 20]) +
         ReadBigEndian<std::uint32_t>(&bytes_[offset + 24]);
}

std::string_view LogReader::ProblemAt(std::size_t offset) const {
  if (!MagicAt(offset)) return "bytes that begin no event";
  if (bytes_.size() - offset < kHeaderBytes) return "an event that the file ends in";
  const auto channel_bytes = ReadBigEndian<std::uint32_t>(&bytes_[offset + 20]);
  // Of a name that the file ends in, what is there; nothing but the file ends it.
  const std::string_view rest(reinterpret_cast<const char*>(bytes_.data()) + offset + kHeaderBytes,
                              bytes_.size() - offset - kHeaderBytes);
  const std::string_view cut = rest.empty() && channel_bytes > 0 ? "?" : rest.substr(0, channel_bytes);
  if (channel_bytes > log_format::kMostChannelBytes) return "a channel with a name of more than 255 bytes";
  return ProblemOf(ReadBigEndian<std::int64_t>(&bytes_[offset + 12]), cut,
                   ReadBigEndian<std::uint32_t>(&bytes_[offset + 24]));
}

std::string_view LogReader::WhyNoEvent(std::size_t offset) const {
  const std::string_view problem = ProblemAt(offset);
  if (!problem.empty()) return problem;
  return *EndOfEvent(offset) > bytes_.size() ? "an event that the file, or the next one, ends in"
                                             : "an event that the next one begins in";
}

LogReader::Place LogReader::PlaceAt(std::size_t offset) const {
  const auto end = MagicAt(offset) ? EndOfEvent(offset) : std::nullopt;
  if (!end) return {false, offset + 1, 1};
  const bool whole = *end <= bytes_.size();
  // The end of the file is a good end. Elsewhere a magic follows, or the length is wrong and the event would
  // swallow the next ones, or else the next one is damaged.
  if (whole && (*end == bytes_.size() || MagicAt(*end))) {
    const Search swallowed = FindSwallowed(offset, *end);
    return {!swallowed.found, swallowed.found.value_or(*end), 1 + swallowed.looked_at};
  }
  const std::size_t limit = std::min(*end, bytes_.size());
  const std::size_t follower = FindFollower(offset + 4, limit, NumberAt(offset));
  return {whole && follower == limit, follower, 1 + follower - offset};
}

LogEvent LogReader::EventAt(std::size_t offset) const {
  const std::byte* header = &bytes_[offset];
  const auto channel_bytes = ReadBigEndian<std::uint32_t>(header + 20);
  const auto* name = reinterpret_cast<const char*>(header + kHeaderBytes);
  const auto data =
      bytes_.subspan(offset + kHeaderBytes + channel_bytes, ReadBigEndian<std::uint32_t>(header + 24));
  LogEvent event;
  event.number = NumberAt(offset);
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
  for (bool skipping = false; offset_ < bytes_.size(); skipping = true) {
    GiveBack();
    const std::size_t offset = offset_;
    const Place place = PlaceAt(offset);
    offset_ = place.next;
    looked_at_ += place.looked_at;
    if (place.event) return EventAt(offset);
    damaged_places_ += skipping ? 0 : 1;
    if (!first_damage_) first_damage_ = Damage{offset, WhyNoEvent(offset)};
    skipped_ += offset_ - offset;
  }
  return std::nullopt;
}

}  // namespace priamos::bus
