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
    if (memory_) return SavedState{.bytes = *memory_, .latest = true};
    if (disk_) return SavedState{.bytes = *disk_, .latest = false};
    return std::nullopt;
  }
  void Save(std::span<const std::byte> state) override {
    memory_.emplace(state.begin(), state.end());
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
  int writes() const { return writes_; }

 private:
  void OnWrite() { ++writes_; }
  std::optional<std::vector<std::byte>> memory_, syncing_, disk_;
  int writes_ = 0;
};

}  // namespace priamos::bus::radio
