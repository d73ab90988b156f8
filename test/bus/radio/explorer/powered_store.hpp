#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bus/radio/link_state.hpp"

namespace priamos::bus::radio {

/// A disk, and before it a memory that forgets without power.
class PoweredStore : public StateStore {
 public:
  std::optional<SavedState> Load() override {
    if (memory_) return SavedState{.bytes = *memory_, .latest = !put_back_ && !behind_};
    if (disk_) return SavedState{.bytes = *disk_, .latest = false};
    return std::nullopt;
  }
  void Save(std::span<const std::byte> state) override {
    newest_.emplace(state.begin(), state.end());
    behind_ = full_;
    if (full_) return;
    memory_.emplace(state.begin(), state.end());
    put_back_ = false;
    saved_.push_back(*memory_);
    OnWrite();
  }
  void StartSync() override {
    if (full_) return;
    syncing_ = memory_;
    OnWrite();
  }
  void AwaitSync() override {
    if (full_) return;
    disk_ = syncing_;
    OnWrite();
  }
  /// `finished`: the disk still got what was being synced.
  void LosePower(bool finished) {
    if (finished && syncing_) disk_ = syncing_;
    memory_.reset();
    syncing_.reset();
  }
  /// The disk is gone, too.
  void LoseEverything() {
    LosePower(false);
    disk_.reset();
  }
  /// Somebody puts back what was saved half of the saves ago, while the machine runs.
  void PutBack() {
    if (saved_.empty()) return;
    memory_ = saved_[saved_.size() / 2];
    put_back_ = true;
  }
  /// From now on nothing can be written, or it can again.
  void SetFull(bool full) { full_ = full; }
  bool full() const { return full_; }
  /// What the end knows: the state saved last, written or not.
  std::optional<std::vector<std::byte>> newest() const {
    if (full_) return newest_;
    return memory_ ? memory_ : disk_;
  }
  int writes() const { return writes_; }

 private:
  void OnWrite() { ++writes_; }
  std::optional<std::vector<std::byte>> memory_, syncing_, disk_;
  std::vector<std::vector<std::byte>> saved_;  ///< everything, in order
  std::optional<std::vector<std::byte>> newest_;
  bool put_back_ = false;
  bool full_ = false;
  bool behind_ = false;  ///< something was saved while it was full
  int writes_ = 0;
};

}  // namespace priamos::bus::radio
