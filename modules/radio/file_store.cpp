#include "radio/file_store.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace priamos::radio {
namespace {

std::optional<std::vector<std::byte>> Read(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  std::vector<std::byte> bytes;
  for (auto at = std::istreambuf_iterator<char>(in); at != std::istreambuf_iterator<char>(); ++at)
    bytes.push_back(static_cast<std::byte>(*at));
  return bytes;
}

[[noreturn]] void Fail(const std::string& path) {
  throw std::runtime_error(
      fmt::format("{}: the radio's state cannot be saved: {}", path, std::strerror(errno)));
}

/// A new file beside the old one, then its name: never half a state.
void Replace(const std::string& path, std::span<const std::byte> state) {
  const std::string next = path + ".new";
  const int fd = open(next.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (fd < 0) Fail(path);
  const bool whole = write(fd, state.data(), state.size()) == static_cast<ssize_t>(state.size());
  close(fd);
  if (!whole || std::rename(next.c_str(), path.c_str()) != 0) Fail(path);
}

void SyncToDisk(const std::string& path, int flags) {
  const int fd = open(path.c_str(), flags | O_CLOEXEC);
  if (fd < 0 || fsync(fd) != 0) Fail(path);
  close(fd);
}

}  // namespace

FileStore::FileStore(std::string path, std::string fast_path)
    : path_(std::move(path)), fast_path_(std::move(fast_path)), thread_([this] { SyncThread(); }) {}

FileStore::~FileStore() {
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

std::optional<std::vector<std::byte>> FileStore::Load() {
  // The RAM disk is empty after a boot, and else newer.
  auto state = fast_path_.empty() ? std::nullopt : Read(fast_path_);
  return state ? state : Read(path_);
}

void FileStore::Save(std::span<const std::byte> state) {
  ThrowFailure();
  state_.assign(state.begin(), state.end());
  Replace(fast_path_.empty() ? path_ : fast_path_, state);
}

void FileStore::StartSync() {
  ThrowFailure();
  {
    const std::lock_guard lock(mutex_);
    to_sync_ = state_;
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
      if (!fast_path_.empty()) Replace(path_, state);
      SyncToDisk(path_, O_RDONLY);
      // The new name must survive a loss of power as well.
      SyncToDisk(std::filesystem::absolute(path_).parent_path(), O_RDONLY | O_DIRECTORY);
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
