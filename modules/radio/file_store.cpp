#include "radio/file_store.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <utility>

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

}  // namespace

std::string BootId() {
  std::string id;
  std::ifstream in("/proc/sys/kernel/random/boot_id");
  std::getline(in, id);
  return id;
}

FileStore::FileStore(std::string path, std::string fast_path, std::string boot)
    : path_(std::move(path)),
      fast_path_(std::move(fast_path)),
      boot_(std::move(boot)),
      thread_([this] { SyncThread(); }) {}

FileStore::~FileStore() {
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

/// The first line names the boot, the rest is the state. Only what this boot has saved is surely the latest.
std::optional<bus::radio::SavedState> FileStore::Read(const std::string& path) const {
  std::ifstream in(path, std::ios::binary);
  std::string boot;
  if (!in || !std::getline(in, boot)) return std::nullopt;
  bus::radio::SavedState state{.bytes = {}, .latest = !boot_.empty() && boot == boot_};
  for (auto at = std::istreambuf_iterator<char>(in); at != std::istreambuf_iterator<char>(); ++at)
    state.bytes.push_back(static_cast<std::byte>(*at));
  return state;
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
  for (const char c : boot_ + "\n") content_.push_back(static_cast<std::byte>(c));
  content_.insert(content_.end(), state.begin(), state.end());
  Replace(fast_path_.empty() ? path_ : fast_path_, content_, false);
}

void FileStore::StartSync() {
  ThrowFailure();
  {
    const std::lock_guard lock(mutex_);
    to_sync_ = content_;
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
        // Without a boot: what follows the RAM disk is never surely the latest, should that be given up.
        Replace(path_, std::span(state).subspan(boot_.size()), true);
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
