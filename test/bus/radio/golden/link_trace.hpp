#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "bus/radio/link_state.hpp"

/// What an end of the link did, as one number.
namespace priamos::bus::radio {

/// A digest of numbers and bytes in their order (FNV-1a, 64 bits).
class Trace {
 public:
  void Number(std::uint64_t value);
  void Bytes(std::span<const std::byte> bytes);
  std::uint64_t digest() const { return digest_; }

 private:
  void Add(std::uint8_t byte);
  std::uint64_t digest_ = 0xcbf29ce484222325;
};

/// Memory that notes in a trace when it is written, and can be set back.
class TracedStore : public StateStore {
 public:
  explicit TracedStore(Trace& trace) : trace_(trace) {}
  std::optional<SavedState> Load() override;
  void Save(std::span<const std::byte> state) override;
  void StartSync() override { trace_.Number('Y'); }
  void AwaitSync() override { trace_.Number('A'); }
  void Lose() { states_.clear(); }
  void RollBack() {
    states_.erase(states_.begin() + static_cast<std::ptrdiff_t>(states_.size() / 2), states_.end());
  }

 private:
  Trace& trace_;
  std::deque<std::vector<std::byte>> states_;  ///< the newest last
};

}  // namespace priamos::bus::radio
