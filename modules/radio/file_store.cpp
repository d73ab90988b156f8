#include "radio/file_store.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cctype>
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

/// Writes a file anew; returns what kept it from that, empty when nothing did.
std::string Replace(const std::string& path, std::span<const std::byte> content, bool durable) {
  const std::string_view text(reinterpret_cast<const char*>(content.data()), content.size());
  if (ReplaceFile(path, text, durable, 0600)) return "";
  return fmt::format("{}: {}", path, std::strerror(errno));
}

/// Why nothing can be saved in the folder of a file, before that is tried; empty when it can.
std::string FolderProblem(const std::string& path) {
  const auto folder = std::filesystem::absolute(path).parent_path();
  if (access(folder.c_str(), W_OK | X_OK) == 0) return "";
  return fmt::format("{}: {}", path, std::strerror(errno));
}

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

namespace {

/// `0b3c61a2-...-1d`, as the kernel names a boot.
bool BeginsWithBootId(std::string_view text) {
  constexpr std::string_view kForm = "xxxxxxxx-xxxx-xxxx-xxxx-xxxxxxxxxxxx";
  if (text.size() < kForm.size()) return false;
  for (std::size_t i = 0; i < kForm.size(); ++i)
    if (kForm[i] == '-' ? text[i] != '-' : std::isxdigit(static_cast<unsigned char>(text[i])) == 0)
      return false;
  return true;
}

}  // namespace

/// A crash may leave a file cut off, or zeros; damage must not keep a link from starting.
bool IsStateFile(std::string_view content) {
  constexpr std::string_view kMark = "PLK";
  if (content.find_first_not_of('\0') == std::string_view::npos || content == "\n") return true;
  const std::size_t end = content.find('\n');
  return BeginsWithBootId(content) ||
         (end != std::string_view::npos && content.substr(end + 1).starts_with(kMark));
}

FileStore::FileStore(std::string path, std::string fast_path, std::string writer, Duration save)
    : path_(std::move(path)),
      fast_path_(std::move(fast_path)),
      writer_(std::move(writer)),
      save_(save),
      lock_(path_),
      thread_([this] { SyncThread(); }) {
  if (!fast_path_.empty()) fast_lock_.emplace(fast_path_);
}

FileStore::~FileStore() {
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

/// Its head, a line, names the writer, the time of writing and the folder; the rest is the state.
std::optional<bus::radio::SavedState> FileStore::Read(const std::string& path) const {
  const RegularFile file(path);
  if (file.missing()) return std::nullopt;
  const auto content = file.Read(kMostStateBytes);
  if (!content)
    throw std::runtime_error(fmt::format(
        "{}: expected the radio's state, a file of at most {} bytes, got {}", Escaped(path), kMostStateBytes,
        file.open() ? "a longer one, or one that cannot be read" : file.problem()));
  const std::size_t end = content->find('\n');
  if (end == std::string::npos) return std::nullopt;
  bus::radio::SavedState state{.bytes = {}, .latest = IsLatest(path, content->substr(0, end))};
  const auto bytes = std::as_bytes(std::span(*content).subspan(end + 1));
  state.bytes.assign(bytes.begin(), bytes.end());
  return state;
}

/// Only what this end has saved since the machine was started is surely the latest, and only while nobody has
/// put a file in its place.
bool FileStore::IsLatest(const std::string& path, const std::string& head) const {
  if (writer_.empty() || !head.starts_with(writer_ + " ")) return false;
  std::istringstream words(head.substr(writer_.size()));
  std::int64_t written_us = 0;
  std::string folder;
  const auto changed = ChangedAt(path);
  if (!(words >> written_us >> folder) || !changed || folder != FolderOf(path)) return false;
  const Duration later = *changed - Duration(written_us);
  return later >= -kClockSteps && later <= save_;
}

std::optional<bus::radio::SavedState> FileStore::Load() {
  auto disk = Read(path_);
  if (fast_path_.empty()) {
    if (disk) disk->latest = disk->latest && !lock_.behind();
    return disk;
  }
  auto fast = Read(fast_path_);
  // The RAM disk is empty after a boot, and else newer; unless the last process of this boot had none.
  if (fast) fast->latest = fast->latest && !(disk && disk->latest) && !fast_lock_->behind();
  if (disk) disk->latest = false;
  return fast ? std::move(fast) : std::move(disk);
}

void FileStore::Save(std::span<const std::byte> state) {
  state_.assign(state.begin(), state.end());
  if (save_problem_.empty()) WriteState();
}

/// The file, or what is noted of it, never says more than what happened, whenever this process ends.
void FileStore::WriteState() {
  const std::string& path = first_path();
  const std::string head = fmt::format("{} {} {}\n", writer_, WallClock().count(), FolderOf(path));
  const auto head_bytes = std::as_bytes(std::span(head));
  std::vector<std::byte> content(head_bytes.begin(), head_bytes.end());
  content.insert(content.end(), state_.begin(), state_.end());
  const bool was_behind = first_lock().behind();
  save_problem_ = Replace(path, content, false);
  if (save_problem_.empty() && was_behind) first_lock().SetBehind(false);
  if (save_problem_.empty() || was_behind) return;
  if (!first_lock().SetBehind(true)) unlink(path.c_str());
}

void FileStore::StartSync() {
  // Without a RAM disk there is nothing new on the disk to wait for.
  if (fast_path_.empty() && !save_problem_.empty()) return;
  {
    const std::lock_guard lock(mutex_);
    // With an empty head: what follows the RAM disk is never surely the latest, should that be given up.
    to_sync_.assign(1, std::byte{'\n'});
    to_sync_.insert(to_sync_.end(), state_.begin(), state_.end());
    ++wanted_;
  }
  changed_.notify_all();
}

void FileStore::AwaitSync() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return done_ == wanted_; });
}

std::string FileStore::in_use() const {
  if (lock_.in_use()) return path_;
  return fast_lock_ && fast_lock_->in_use() ? fast_path_ : "";
}

std::string FileStore::problem() {
  {
    const std::lock_guard lock(mutex_);
    if (!save_problem_.empty()) return save_problem_;
    if (!sync_problem_.empty()) return sync_problem_;
  }
  const std::string of_first = FolderProblem(first_path());
  return of_first.empty() ? FolderProblem(path_) : of_first;
}

void FileStore::Retry() {
  std::unique_lock lock(mutex_);
  const bool sync_failed = !sync_problem_.empty();
  lock.unlock();
  if (save_problem_.empty() && !sync_failed) return;
  if (!save_problem_.empty()) WriteState();
  StartSync();
}

void FileStore::SyncThread() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return end_ || done_ != wanted_; });
    if (done_ == wanted_) return;
    const std::uint64_t number = wanted_;
    const std::vector<std::byte> state = std::move(to_sync_);
    lock.unlock();
    std::string problem;
    // Without a RAM disk the file holds this state, or one that is newer.
    if (!fast_path_.empty())
      problem = Replace(path_, state, true);
    else if (!SyncFile(path_))
      problem = fmt::format("{}: {}", path_, std::strerror(errno));
    lock.lock();
    done_ = number;
    sync_problem_ = std::move(problem);
    changed_.notify_all();
  }
}

}  // namespace priamos::radio
