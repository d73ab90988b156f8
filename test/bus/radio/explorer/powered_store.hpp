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
    if (memory_) return SavedState{.bytes = *memory_, .latest = !put_back_};
    if (disk_) return SavedState{.bytes = *disk_, .latest = false};
    return std::nullopt;
  }
  void Save(std::span<const std::byte> state) override {
    memory_.emplace(state.begin(), state.end());
    put_back_ = false;
    saved_.push_back(*memory_);
    OnWrite();
  }
  void StartSync() override {
    syncing_ = memory_;
    OnWrite();
  }
  void AwaitSync() override {
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
  int writes() const { return writes_; }

 private:
  void OnWrite() { ++writes_; }
  std::optional<std::vector<std::byte>> memory_, syncing_, disk_;
  std::vector<std::vector<std::byte>> saved_;  ///< everything, in order
  bool put_back_ = false;
  int writes_ = 0;
};

}  // namespace priamos::bus::radio
