#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace priamos {

/// A regular file, opened for reading. A pipe, a device or a folder of that name is not opened: who reads one
/// waits for somebody, or reads without end. Never blocks.
class RegularFile {
 public:
  explicit RegularFile(const std::string& path);
  RegularFile(const RegularFile&) = delete;
  RegularFile& operator=(const RegularFile&) = delete;
  ~RegularFile();

  bool open() const { return fd_ >= 0; }
  /// Its descriptor, which it closes; -1 when it is not open.
  int fd() const { return fd_; }
  /// Whether there is nothing of that name.
  bool missing() const { return missing_; }
  /// What there is instead of a file that can be read, for `expected ..., got ...`: `none`, `a pipe`, `a
  /// folder`, `a device`, `a socket`, `one that cannot be opened (Permission denied)`. Empty: it is open.
  const std::string& problem() const { return problem_; }
  /// Permissions of owner, group and others.
  unsigned mode() const { return mode_; }
  /// Whether only its owner may read and write it, as it should be with a secret.
  bool is_private() const { return (mode_ & 0077U) == 0; }
  /// All of it; nullopt when it is longer than `most_bytes` or cannot be read.
  std::optional<std::string> Read(std::size_t most_bytes) const;

 private:
  int fd_ = -1;
  bool missing_ = false;
  std::string problem_;
  unsigned mode_ = 0;
};

/// What is called `path` and is no regular file: `a pipe`, `a folder`, `a device`, `a socket`. Empty: a
/// regular file, or nothing. Opens nothing.
std::string OtherThanAFileAt(const std::string& path);

}  // namespace priamos
