#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace priamos::bus::radio {

/// What a store held when it was read.
struct SavedState {
  std::vector<std::byte> bytes;
  /// Nothing was saved after it. After a loss of power a disk may hold an older state.
  bool latest = true;
  friend bool operator==(const SavedState&, const SavedState&) = default;
};

/// Place where an end of the link keeps what must outlive the process: a file on a robot, memory in a test.
class StateStore {
 public:
  virtual ~StateStore() = default;
  /// The newest state that is left; nullopt if there is none.
  virtual std::optional<SavedState> Load() = 0;
  /// Replaces the saved state as a whole. It survives a restart of the process at once, and one of the
  /// machine after a sync. Does not wait for the disk: an emergency stop must not. Nor does it throw: of a
  /// state that could not be saved, the one that Load() finds after the next start is not the latest.
  virtual void Save(std::span<const std::byte> state) = 0;
  /// Begins to write the state saved last to disk, where it survives a loss of power.
  virtual void StartSync() = 0;
  /// Waits until the sync that was begun last is finished.
  virtual void AwaitSync() = 0;
};

/// A store that lives as long as the process. After each start the ends agree on a new epoch.
class MemoryStore : public StateStore {
 public:
  std::optional<SavedState> Load() override { return state_; }
  void Save(std::span<const std::byte> state) override {
    state_.emplace(SavedState{{state.begin(), state.end()}});
  }
  void StartSync() override {}
  void AwaitSync() override {}
  void Lose() { state_.reset(); }

 private:
  std::optional<SavedState> state_;
};

/// An event accepted for sending and not yet acknowledged.
struct StoredEvent {
  std::uint8_t channel = 0;  ///< index in the channel table
  std::uint8_t first = 0;    ///< number of its first segment
  std::int64_t packed_utime = 0;
  std::uint32_t bits = 0;
  std::vector<std::byte> packed;
  friend bool operator==(const StoredEvent&, const StoredEvent&) = default;
};

/// The persistent state of one end.
struct LinkState {
  std::uint32_t table_hash = 0;             ///< events and numbers below belong to this channel table
  std::uint64_t epoch = 0;                  ///< 0: none agreed yet
  std::uint64_t send_next = 1;              ///< first counter from which on none was ever sent in this epoch
  std::uint64_t receive_floor = 0;          ///< counter above which none was ever accepted in this epoch
  bool floor_exact = true;                  ///< false: receive_floor was reserved ahead
  std::uint32_t stream = 0;                 ///< names this end's numbering of events
  std::uint32_t peer_stream = 0;            ///< names the other end's numbering of events
  std::vector<std::uint8_t> send_event;     ///< per channel: number of the next new segment
  std::vector<std::uint8_t> receive_event;  ///< per channel: number of the next segment expected
  std::vector<std::uint8_t> receive_known;  ///< per channel: 1 when receive_event is valid
  std::vector<StoredEvent> events;          ///< per channel in order
  std::uint32_t key_check = 0;              ///< the key of the epoch, see KeyCheck; 0: not noted
  friend bool operator==(const LinkState&, const LinkState&) = default;
};

/// Bytes of a state, with a checksum.
std::vector<std::byte> Serialise(const LinkState& state);
/// State from its bytes; nullopt if it is damaged; it then counts as lost, which is safe.
std::optional<LinkState> ParseLinkState(std::span<const std::byte> bytes);

}  // namespace priamos::bus::radio
