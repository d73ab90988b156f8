#include "bus/log/log_recorder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "bus/log/log_event.hpp"

namespace priamos::bus {
namespace {

constexpr std::size_t kBufferBytes = 1 << 16;
constexpr Duration kFlushPeriod = std::chrono::milliseconds(200);
constexpr Duration kCheckPeriod = std::chrono::milliseconds(500);
constexpr Duration kRetryPeriod = std::chrono::seconds(1);
constexpr std::uint64_t kMegabyte = 1'000'000;
constexpr std::uint64_t kWorthARetry = kMegabyte;  // free bytes; with less the next file would end at once

/// Writes all of it; on failure `written` is the number of bytes that were written.
bool WriteAll(int fd, std::string_view bytes, std::size_t& written) {
  for (written = 0; written < bytes.size();) {
    const ssize_t n = write(fd, bytes.data() + written, bytes.size() - written);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    written += static_cast<std::size_t>(n);
  }
  return true;
}

}  // namespace

LogRecorder::LogRecorder(const std::filesystem::path& path, const RecorderLimits& limits, Time now)
    : base_(path), limits_(limits) {
  if (!Open(now)) throw std::runtime_error(alarm_);
}

LogRecorder::~LogRecorder() {
  Close();
}

std::filesystem::path LogRecorder::NextPath() {
  std::filesystem::path path = base_;
  if (file_count_ > 0)
    path.replace_filename(
        fmt::format("{}.{}{}", base_.stem().string(), file_count_, base_.extension().string()));
  ++file_count_;
  return path;
}

bool LogRecorder::Open(Time now) {
  std::filesystem::path path;
  do {  // what another recording left under such a name stays
    path = NextPath();
    fd_ = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  } while (fd_ < 0 && errno == EEXIST);
  if (fd_ < 0) {
    --file_count_;  // the name is free for the next attempt
    alarm_ = fmt::format("{}: cannot be written: {}", path.string(), std::strerror(errno));
    return false;
  }
  files_.push_back(path);
  file_bytes_ = 0;
  opened_ = now;
  alarm_.clear();
  if (scribe_) scribe_->Restart();
  while (limits_.keep_files > 0 && files_.size() > limits_.keep_files) DeleteOldest();
  return true;
}

void LogRecorder::Close() {
  Flush();
  if (fd_ >= 0) close(fd_);
  fd_ = -1;
}

void LogRecorder::DeleteOldest() {
  std::error_code ignored;
  std::filesystem::remove(files_.front(), ignored);
  files_.pop_front();
}

void LogRecorder::Fail(const std::string& what) {
  alarm_ = fmt::format("{}: recording stopped: {}; goes on when {} MB are free", file().string(), what,
                       (limits_.keep_free_bytes + kWorthARetry) / kMegabyte);
  lost_ += event_ends_.size();
  buffer_.clear();
  event_ends_.clear();
  if (fd_ >= 0) close(fd_);
  fd_ = -1;
  if (file_bytes_ > 0 || files_.empty()) return;
  std::error_code ignored;
  std::filesystem::remove(files_.back(), ignored);  // nothing is in it: the next attempt takes its name
  files_.pop_back();
  --file_count_;
}

void LogRecorder::NoteWritten(std::size_t events, std::size_t bytes) {
  file_bytes_ += bytes;
  total_bytes_ += bytes;
  recorded_ += events;
  event_ends_.erase(event_ends_.begin(), event_ends_.begin() + static_cast<std::ptrdiff_t>(events));
}

void LogRecorder::Flush() {
  if (fd_ < 0 || buffer_.empty()) return;
  std::size_t written = 0;
  if (WriteAll(fd_, buffer_, written)) {
    NoteWritten(event_ends_.size(), buffer_.size());
    buffer_.clear();
    return;
  }
  const std::string why = std::strerror(errno);
  const auto cut = std::upper_bound(event_ends_.begin(), event_ends_.end(), written);
  const auto whole = static_cast<std::size_t>(cut - event_ends_.begin());
  NoteWritten(whole, whole > 0 ? *(cut - 1) : 0);
  // The file ends with its last whole event, so that every reader finds nothing to complain about.
  const bool truncated = ftruncate(fd_, static_cast<off_t>(file_bytes_)) == 0;
  Fail(truncated ? why : why + ", and the cut-off event could not be taken back");
}

bool LogRecorder::DueForSplit(Time now) const {
  const bool large = limits_.split_bytes > 0 && file_bytes_ + buffer_.size() >= limits_.split_bytes;
  const bool old = limits_.split_time.count() > 0 && now - opened_ >= limits_.split_time;
  return (large || old) && file_bytes_ + buffer_.size() > 0;
}

void LogRecorder::Add(Time now, std::string_view channel, std::span<const std::byte> bytes) {
  if (!IsWritable(ToUtime(now), channel, bytes.size())) {
    ++unwritable_;
    return Lose();
  }
  if (fd_ < 0) return Lose();
  if (DueForSplit(now)) Split(now);
  if (fd_ < 0) return Lose();
  if (scribe_)
    for (const auto& text : scribe_->TextsBefore(bytes, ToUtime(now))) Append(now, kTypeText, text);
  Append(now, channel, bytes);
  if (buffer_.size() >= kBufferBytes) Flush();
}

void LogRecorder::DefineTypesOf(const Schema& schema) {
  scribe_.emplace([&schema](std::span<const std::byte> bytes) { return schema.Of(bytes); });
}

void LogRecorder::Append(Time now, std::string_view channel, std::span<const std::byte> bytes) {
  AppendEvent(buffer_, next_number_++, ToUtime(now), channel, bytes);
  event_ends_.push_back(buffer_.size());
}

void LogRecorder::Lose() {
  ++lost_;
  ++next_number_;  // the reader reports the gap in the numbers as a loss
}

void LogRecorder::Split(Time now) {
  Close();
  if (alarm_.empty()) Open(now);
}

bool LogRecorder::EnoughIsFree(std::uint64_t bytes) const {
  struct statvfs disk {};
  const auto folder = std::filesystem::absolute(base_).parent_path();
  return statvfs(folder.c_str(), &disk) != 0 || disk.f_bavail * disk.f_frsize >= bytes;
}

void LogRecorder::WatchFreeSpace() {
  if (limits_.keep_free_bytes == 0) return;
  while (limits_.keep_files > 0 && files_.size() > 1 && !EnoughIsFree(limits_.keep_free_bytes))
    DeleteOldest();
  if (EnoughIsFree(limits_.keep_free_bytes)) return;
  Flush();
  if (fd_ >= 0) Fail(fmt::format("less than {} MB are free", limits_.keep_free_bytes / kMegabyte));
}

void LogRecorder::Tick(Time now) {
  if (fd_ >= 0 && now >= next_flush_) {
    next_flush_ = now + kFlushPeriod;
    Flush();
  }
  if (now < next_check_) return;
  next_check_ = now + (fd_ >= 0 ? kCheckPeriod : kRetryPeriod);
  if (fd_ < 0 && (!EnoughIsFree(limits_.keep_free_bytes + kWorthARetry) || !Open(now))) return;
  WatchFreeSpace();
}

}  // namespace priamos::bus
