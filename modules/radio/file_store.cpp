#include "radio/file_store.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "common/input/quoted.hpp"
#include "common/input/regular_file.hpp"
#include "common/replace_file.hpp"

namespace priamos::radio {
namespace {

[[noreturn]] void Fail(const std::string& path) {
  throw std::runtime_error(
      fmt::format("{}: the radio's state cannot be saved: {}", path, std::strerror(errno)));
}

void Replace(const std::string& path, std::span<const std::byte> state, bool durable) {
  const std::string_view content(reinterpret_cast<const char*>(state.data()), state.size());
  if (!ReplaceFile(path, content, durable, 0600)) Fail(path);
}

/// Far more than any state of a link.
constexpr std::size_t kMostBytes = 4 << 20;

/// The time that the kernel gives a changed file is that of its last tick.
constexpr Duration kClockSteps{20'000};

/// Time by the wall clock, since 1970.
Duration WallClock() {
  return std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch());
}

/// When a file was written, or came under this name, last: by the wall clock, since 1970.
std::optional<Duration> ChangedAt(const std::string& path) {
  struct stat info {};
  if (stat(path.c_str(), &info) != 0) return std::nullopt;
  return std::chrono::duration_cast<Duration>(std::chrono::seconds(info.st_ctim.tv_sec) +
                                              std::chrono::nanoseconds(info.st_ctim.tv_nsec));
}

/// The folder in which a file lies, and no other one that gets its name; empty when there is none.
std::string FolderOf(const std::string& path) {
  const auto folder = std::filesystem::absolute(path).parent_path();
  struct stat info {};
  return stat(folder.c_str(), &info) == 0 ? fmt::format("{}:{}", info.st_dev, info.st_ino) : "";
}

}  // namespace

std::string BootId() {
  std::string id;
  std::ifstream in("/proc/sys/kernel/random/boot_id");
  std::getline(in, id);
  return id;
}

FileStore::FileStore(std::string path, std::string fast_path, std::string boot, Duration save)
    : path_(std::move(path)),
      fast_path_(std::move(fast_path)),
      boot_(std::move(boot)),
      save_(save),
      thread_([this] { SyncThread(); }) {}

FileStore::~FileStore() {
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

/// Its head, a line, names the boot, the time of writing and the folder; the rest is the state.
std::optional<bus::radio::SavedState> FileStore::Read(const std::string& path) const {
  const RegularFile file(path);
  if (file.missing()) return std::nullopt;
  const auto content = file.Read(kMostBytes);
  if (!content)
    throw std::runtime_error(
        fmt::format("{}: expected the radio's state, a file of at most {} bytes, got {}", Escaped(path),
                    kMostBytes, file.open() ? "a longer one, or one that cannot be read" : file.problem()));
  const std::size_t end = content->find('\n');
  if (end == std::string::npos) return std::nullopt;
  bus::radio::SavedState state{.bytes = {}, .latest = IsLatest(path, content->substr(0, end))};
  const auto bytes = std::as_bytes(std::span(*content).subspan(end + 1));
  state.bytes.assign(bytes.begin(), bytes.end());
  return state;
}

/// Only what this boot has saved is surely the latest, and only while nobody has put a file in its place.
bool FileStore::IsLatest(const std::string& path, const std::string& head) const {
  if (boot_.empty() || !head.starts_with(boot_ + " ")) return false;
  std::istringstream words(head.substr(boot_.size()));
  std::int64_t written_us = 0;
  std::string folder;
  const auto changed = ChangedAt(path);
  if (!(words >> written_us >> folder) || !changed || folder != FolderOf(path)) return false;
  const Duration later = *changed - Duration(written_us);
  return later >= -kClockSteps && later <= save_;
}

std::optional<bus::radio::SavedState> FileStore::Load() {
  if (fast_path_.empty()) return Read(path_);
  auto disk = Read(path_);
  auto fast = Read(fast_path_);
  // The RAM disk is empty after a boot, and else newer; unless the last process of this boot had none.
  if (fast) fast->latest = fast->latest && !(disk && disk->latest);
  if (disk) disk->latest = false;
  return fast ? std::move(fast) : std::move(disk);
}

void FileStore::Save(std::span<const std::byte> state) {
  ThrowFailure();
  content_.clear();
  const std::string& path = fast_path_.empty() ? path_ : fast_path_;
  const std::string head = fmt::format("{} {} {}\n", boot_, WallClock().count(), FolderOf(path));
  head_bytes_ = head.size();
  for (const char c : head) content_.push_back(static_cast<std::byte>(c));
  content_.insert(content_.end(), state.begin(), state.end());
  Replace(path, content_, false);
}

void FileStore::StartSync() {
  ThrowFailure();
  {
    const std::lock_guard lock(mutex_);
    // With an empty head: what follows the RAM disk is never surely the latest, should that be given up.
    to_sync_.assign(content_.begin() + static_cast<std::ptrdiff_t>(head_bytes_) - 1, content_.end());
    ++wanted_;
  }
  changed_.notify_all();
}

void FileStore::AwaitSync() {
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return done_ == wanted_; });
  }
  ThrowFailure();
}

void FileStore::ThrowFailure() {
  std::unique_lock lock(mutex_);
  const std::exception_ptr failure = std::exchange(failure_, nullptr);
  lock.unlock();
  if (failure) std::rethrow_exception(failure);
}

void FileStore::SyncThread() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return end_ || done_ != wanted_; });
    if (done_ == wanted_) return;
    const std::uint64_t number = wanted_;
    const std::vector<std::byte> state = std::move(to_sync_);
    lock.unlock();
    std::exception_ptr failure;
    try {
      // Without a RAM disk the file holds this state, or one that is newer.
      if (!fast_path_.empty()) {
        Replace(path_, state, true);
      } else if (!SyncFile(path_)) {
        Fail(path_);
      }
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    done_ = number;
    if (failure) failure_ = failure;
    changed_.notify_all();
  }
}

}  // namespace priamos::radio
