#include "common/replace_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>

namespace priamos {
namespace {

/// Closes `fd`, keeps errno as it was.
bool Close(int fd, bool good) {
  const int error = errno;
  close(fd);
  errno = error;
  return good;
}

bool Sync(const std::string& path, int flags) {
  const int fd = open(path.c_str(), flags | O_CLOEXEC);
  return fd >= 0 && Close(fd, fsync(fd) == 0);
}

/// A folder that gives itself not to be read cannot be synced, its files can.
void SyncFolderOf(const std::string& path) {
  Sync(std::filesystem::absolute(path).parent_path(), O_RDONLY | O_DIRECTORY);
}

bool Write(const std::string& path, std::string_view content, bool durable, unsigned mode) {
  const int fd = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, mode);
  if (fd < 0) return false;
  const ssize_t n = write(fd, content.data(), content.size());
  const bool whole = n == static_cast<ssize_t>(content.size());
  if (n >= 0 && !whole) errno = ENOSPC;  // a disk takes a part, and nothing of the next write
  return Close(fd, whole && (!durable || fsync(fd) == 0));
}

}  // namespace

bool ReplaceFile(const std::string& path, std::string_view content, bool durable, unsigned mode) {
  const std::string next = path + ".new";
  if (!Write(next, content, durable, mode) || std::rename(next.c_str(), path.c_str()) != 0) {
    const int error = errno;
    unlink(next.c_str());  // what a full disk took of it is of no use
    errno = error;
    return false;
  }
  if (durable) SyncFolderOf(path);
  return true;
}

bool SyncFile(const std::string& path) {
  if (!Sync(path, O_RDONLY)) return false;
  SyncFolderOf(path);
  return true;
}

}  // namespace priamos
