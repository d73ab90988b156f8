#include "common/input/regular_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace priamos {
namespace {

constexpr std::size_t kReadAtOnce = 65536;

/// What it is instead of a regular file; empty: it is one.
std::string OtherThanAFile(mode_t mode) {
  if (S_ISREG(mode)) return "";
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a pipe";
  return S_ISSOCK(mode) ? "a socket" : "a device";
}

std::string WhyNotOpened(int error) {
  return fmt::format("one that cannot be opened ({})", std::strerror(error));
}

}  // namespace

RegularFile::RegularFile(const std::string& path) {
  struct stat info {};
  if (stat(path.c_str(), &info) != 0) {
    missing_ = errno == ENOENT || errno == ENOTDIR;
    problem_ = missing_ ? "none" : WhyNotOpened(errno);
    return;
  }
  // Opening alone does something to some devices; and what is there now may be another one.
  problem_ = OtherThanAFile(info.st_mode);
  if (!problem_.empty()) return;
  fd_ = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (fd_ < 0 || fstat(fd_, &info) != 0)
    problem_ = WhyNotOpened(errno);
  else
    problem_ = OtherThanAFile(info.st_mode);
  mode_ = info.st_mode & 0777U;
  if (problem_.empty() || fd_ < 0) return;
  close(fd_);
  fd_ = -1;
}

RegularFile::~RegularFile() {
  if (fd_ >= 0) close(fd_);
}

std::optional<std::string> RegularFile::Read(std::size_t most_bytes) const {
  std::string content;
  while (fd_ >= 0 && content.size() <= most_bytes) {
    const std::size_t had = content.size();
    content.resize(std::min(had + kReadAtOnce, most_bytes + 1));
    const ssize_t n = read(fd_, content.data() + had, content.size() - had);
    if (n < 0) return std::nullopt;
    content.resize(had + static_cast<std::size_t>(n));
    if (n == 0) return content;
  }
  return std::nullopt;
}

std::string OtherThanAFileAt(const std::string& path) {
  struct stat info {};
  return stat(path.c_str(), &info) == 0 ? OtherThanAFile(info.st_mode) : "";
}

}  // namespace priamos
