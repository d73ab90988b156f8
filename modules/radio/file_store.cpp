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

void Replace(const std::string& path, std::span<const std::byte> state, bool durable) {
  const std::string_view content(reinterpret_cast<const char*>(state.data()), state.size());
  if (!ReplaceFile(path, content, durable, 0600)) Fail(path);
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
  Replace(fast_path_.empty() ? path_ : fast_path_, state, false);
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
