#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "bus/radio/link_state.hpp"
#include "common/time.hpp"
#include "radio/state_lock.hpp"

namespace priamos::radio {

/// Identifies the time since this machine was started, as the kernel does; empty when it does not.
std::string BootId();

/// Far more than any state of a link.
inline constexpr std::size_t kMostStateBytes = 4 << 20;

/// Whether a file may be replaced by a state: it holds one, whole or not, or nothing.
bool IsStateFile(std::string_view content);

/// Keeps an end's state in a file, which is replaced as a whole: a crash at any moment leaves the old or the
/// new state. A thread of its own waits for the disk. With a second file on a RAM disk (/run) no other thread
/// does: the state survives the process there at once, and the file on the disk follows with each sync.
///
/// A file that cannot be written (disk full, read-only, gone) does not stop the link: problem() says why,
/// the state goes on in this process alone, Retry() writes it as soon as that is possible. Until then the
/// file is behind, which is noted in its StateLock; where that cannot be, the file is removed. Either way the
/// next start takes it for one after a loss of power.
///
/// An older file that was put back, or a copy, is noticed by its time of change, which the kernel sets and
/// nobody else can: it is later than the time that was written into the file. So is a folder that was put
/// back, by what the file says of the folder in which it was written. Such a state is not the latest.
/// A file system that is set back as a whole, times and all, is not noticed.
class FileStore : public bus::radio::StateStore {
 public:
  /// Store in the file `path` and the file `fast_path`; when that is empty, `path` holds everything. `writer`
  /// names the time since the machine was started, and the end of the link: what another one wrote need not
  /// be the last that this one saved. A save takes no longer than `save`, or its file counts as put back.
  explicit FileStore(std::string path, std::string fast_path = "", std::string writer = BootId(),
                     Duration save = std::chrono::seconds(1));
  ~FileStore() override;
  FileStore(const FileStore&) = delete;
  FileStore& operator=(const FileStore&) = delete;

  std::optional<bus::radio::SavedState> Load() override;
  void Save(std::span<const std::byte> state) override;
  void StartSync() override;
  void AwaitSync() override;

  /// The file of this store that another one uses already, in this process or another; empty: none.
  std::string in_use() const;
  /// What cannot be written, and why: `FILE: No space left on device`. Empty when all was, and the folders
  /// can be written.
  std::string problem();
  /// Tries again to write what could not be written; Save() does not.
  void Retry();

 private:
  void SyncThread();
  void WriteState();
  const std::string& first_path() const { return fast_path_.empty() ? path_ : fast_path_; }

  std::optional<bus::radio::SavedState> Read(const std::string& path) const;
  bool IsLatest(const std::string& path, const std::string& head) const;
  StateLock& first_lock() { return fast_lock_ ? *fast_lock_ : lock_; }

  const std::string path_, fast_path_, writer_;
  const Duration save_;
  StateLock lock_;                      ///< of `path_`
  std::optional<StateLock> fast_lock_;  ///< of `fast_path_`
  std::vector<std::byte> state_;        ///< saved last
  std::string save_problem_;            ///< of the file that holds each save

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::byte> to_sync_;       ///< of the file on the disk beside a RAM disk
  std::uint64_t wanted_ = 0, done_ = 0;  ///< number of the newest sync asked for, and of the newest finished
  bool end_ = false;
  std::string sync_problem_;
  std::thread thread_;
};

}  // namespace priamos::radio
