#pragma once

#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "bus/radio/link_state.hpp"
#include "common/time.hpp"

namespace priamos::radio {

/// Identifies the time since this machine was started, as the kernel does; empty when it does not.
std::string BootId();

/// Keeps an end's state in a file, which is replaced as a whole: a crash at any moment leaves the old or the
/// new state. A thread of its own waits for the disk. With a second file on a RAM disk (/run) no other thread
/// does: the state survives the process there at once, and the file on the disk follows with each sync. Every
/// call throws std::runtime_error if a file cannot be written, or if a sync failed since the last call: a
/// link that cannot store its counters must not go on.
///
/// An older file that was put back, or a copy, is noticed by its time of change, which the kernel sets and
/// nobody else can: it is later than the time that was written into the file. So is a folder that was put
/// back, by what the file says of the folder in which it was written. Such a state is not the latest.
/// A file system that is set back as a whole, times and all, is not noticed.
class FileStore : public bus::radio::StateStore {
 public:
  /// Store in the file `path` and the file `fast_path`; when that is empty, `path` holds everything. `boot`
  /// names the time since the machine was started: what another one wrote to a disk need not be the last that
  /// it saved. A save takes no longer than `save`, or its file counts as put back.
  explicit FileStore(std::string path, std::string fast_path = "", std::string boot = BootId(),
                     Duration save = std::chrono::seconds(1));
  ~FileStore() override;
  FileStore(const FileStore&) = delete;
  FileStore& operator=(const FileStore&) = delete;

  std::optional<bus::radio::SavedState> Load() override;
  void Save(std::span<const std::byte> state) override;
  void StartSync() override;
  void AwaitSync() override;

 private:
  void SyncThread();
  void ThrowFailure();

  std::optional<bus::radio::SavedState> Read(const std::string& path) const;
  bool IsLatest(const std::string& path, const std::string& head) const;

  const std::string path_, fast_path_, boot_;
  const Duration save_;
  std::vector<std::byte> content_{std::byte{'\n'}};  ///< of the file: its head, and the state saved last
  std::size_t head_bytes_ = 1;  ///< of the line with the boot, the time of writing and the folder

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::byte> to_sync_;       ///< of the file on the disk beside a RAM disk
  std::uint64_t wanted_ = 0, done_ = 0;  ///< number of the newest sync asked for, and of the newest finished
  bool end_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace priamos::radio
