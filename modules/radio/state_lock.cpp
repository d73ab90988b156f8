#include "radio/state_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sodium.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <filesystem>

namespace priamos::radio {
namespace {

constexpr char kBehind = 'b', kCurrent = 'c';

/// The same for all names of a file: its folder and its name there.
std::uint64_t InodeNumber(const std::string& path) {
  const std::filesystem::path file = FileOf(path);
  struct stat folder {};
  const std::string key =
      stat(file.parent_path().c_str(), &folder) == 0
          ? fmt::format("{}:{}:{}", folder.st_dev, folder.st_ino, file.filename().string())
          : file.string();
  std::uint64_t number = 0;
  crypto_generichash(reinterpret_cast<unsigned char*>(&number), sizeof number,
                     reinterpret_cast<const unsigned char*>(key.data()), key.size(), nullptr, 0);
  return number;
}

}  // namespace

std::filesystem::path FileOf(const std::string& path) {
  constexpr int kMostLinks = 8;
  std::error_code error;
  std::filesystem::path file = std::filesystem::absolute(path, error);
  for (int i = 0; i < kMostLinks && std::filesystem::is_symlink(file, error); ++i)
    file = file.parent_path() / std::filesystem::read_symlink(file, error);
  const auto canonical = std::filesystem::weakly_canonical(file, error);
  return error ? file : canonical;
}

StateLock::StateLock(const std::string& path, const std::string& shared)
    : name_(fmt::format("{}/priamos-radio-{:016x}", shared, InodeNumber(path))) {
  Open();
}

/// Who ends in order takes its file away: one that is opened just then is no longer the one of that name.
void StateLock::Open() {
  constexpr int kTries = 10;
  for (int i = 0; i < kTries; ++i) {
    fd_ = open(name_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0600);
    struct stat own {
    }, named{};
    if (fd_ < 0) return;
    const bool locked = flock(fd_, LOCK_EX | LOCK_NB) == 0;
    in_use_ = !locked && errno == EWOULDBLOCK;
    const bool good = fstat(fd_, &own) == 0 && S_ISREG(own.st_mode) && own.st_uid == geteuid();
    const bool same = good && stat(name_.c_str(), &named) == 0 && named.st_ino == own.st_ino;
    // Written now, so that noting something later needs no memory.
    if (same && own.st_size == 0 && locked) SetBehind(false);
    if (same) return;
    close(fd_);
    fd_ = -1;
    in_use_ = false;
    if (!good) return;
  }
}

StateLock::~StateLock() {
  if (fd_ < 0) return;
  if (!in_use_ && !behind()) unlink(name_.c_str());
  close(fd_);
}

bool StateLock::behind() const {
  char byte = kCurrent;
  return fd_ >= 0 && pread(fd_, &byte, 1, 0) == 1 && byte == kBehind;
}

bool StateLock::SetBehind(bool behind) {
  const char byte = behind ? kBehind : kCurrent;
  return fd_ >= 0 && pwrite(fd_, &byte, 1, 0) == 1;
}

}  // namespace priamos::radio
