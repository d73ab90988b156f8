#pragma once

#include <filesystem>
#include <string>

namespace priamos::radio {

/// The file that a name stands for, also where a symbolic link leads to none yet.
std::filesystem::path FileOf(const std::string& path);

/// What a machine knows of a state file beside the file itself, until it is started again: which process uses
/// it, and whether the file is behind what that process did. A lock and one byte in shared memory, which can
/// be written when the file cannot. Without shared memory it knows nothing.
class StateLock {
 public:
  /// Takes the lock of the state file `path`, which need not exist. `shared` is the folder of shared memory.
  explicit StateLock(const std::string& path, const std::string& shared = "/dev/shm");
  ~StateLock();
  StateLock(const StateLock&) = delete;
  StateLock& operator=(const StateLock&) = delete;

  /// Whether another store has the lock, of this process or of another one.
  bool in_use() const { return in_use_; }
  /// Whether the file was left behind: its state is not the latest.
  bool behind() const;
  /// Notes whether the file is behind. Returns whether that could be noted.
  bool SetBehind(bool behind);

 private:
  void Open();

  std::string name_;
  int fd_ = -1;
  bool in_use_ = false;
};

}  // namespace priamos::radio
