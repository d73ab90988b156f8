#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bus/radio/channels/channel_table.hpp"
#include "bus/radio/channels/event_stream.hpp"
#include "bus/radio/channels/send_queue.hpp"
#include "bus/radio/frame/epoch.hpp"
#include "bus/radio/link_state.hpp"

namespace priamos::bus::radio {

/// The keys that an end has, see KeyCheck; 0: none is noted, or there is no next one.
struct KeyChecks {
  std::uint32_t current = 0;
  std::uint32_t next = 0;
};

/// The persistent state of an end, and when it is written. Counters are reserved in blocks: the block is on
/// disk before its first counter is used, so that after a crash an end at worst skips some, and never sends
/// one twice nor accepts one twice. The next block is written while counters of the last one are left, so
/// that sending waits for the disk only if that takes longer than they last.
class LinkMemory {
 public:
  /// Reads the store. If the state is missing, damaged or of another channel table, this end begins without
  /// one, in a new epoch and with new numbers of events. So it does if the state may be an older one, as
  /// after a loss of power: each end would take new events for those that it has heard or sent. The events
  /// that waited in it are dropped, because they may have arrived; RestoreEvents() counts them as refused.
  /// A state of none of the `keys` loses its epoch alone: numbers of events do not depend on a key.
  LinkMemory(StateStore& store, const ChannelTable& table, const NonceSource& nonces,
             const KeyChecks& keys = {});

  std::uint64_t epoch() const { return state_.epoch; }
  /// Whether the epoch is one under the next key: this end had changed to it.
  bool under_next_key() const { return under_next_key_; }
  std::uint32_t stream() const { return state_.stream; }
  std::uint64_t receive_floor() const { return state_.receive_floor; }
  bool floor_exact() const { return state_.floor_exact; }

  /// The counter for the next frame; it is not given out again in this epoch.
  std::uint64_t TakeCounter();
  std::uint64_t last_counter() const { return next_counter_ - 1; }
  /// The other end accepts only counters above `floor`.
  void SkipCounters(std::uint64_t floor);
  /// A frame with this counter was accepted, the highest so far; to be called before it is used.
  void NoteAccepted(std::uint64_t highest);
  /// Notes that the next epoch is one under this key; written with that epoch.
  void UseKey(std::uint32_t check) { state_.key_check = check; }
  /// Notes that counters begin anew. Returns whether the other end's event numbers do so, too.
  bool ChangeEpoch(std::uint64_t epoch, std::uint32_t peer_stream);

  /// Puts back the events that were waiting, and the numbers expected.
  void RestoreEvents(SendQueue& queue, std::vector<EventReceiver>& receivers) const;
  void StoreEvents(const SendQueue& queue, const std::vector<EventReceiver>& receivers);
  /// Writes to `store` from now on, which must be a copy of the one before.
  void MoveTo(StateStore& store) { store_ = &store; }
  /// Ends in order: nothing is reserved ahead any more.
  void Close(std::uint64_t highest_accepted);

 private:
  void ChooseKey(const KeyChecks& keys);
  void ForgetEpoch();
  void BeginAnew(const ChannelTable& table, const NonceSource& nonces);
  void Save() { store_->Save(Serialise(state_)); }
  void Reserve();
  void StartSync();
  void AwaitSync();

  StateStore* store_;
  std::size_t channels_;
  LinkState state_;
  bool under_next_key_ = false;  ///< at the start
  bool events_dropped_ = false;  ///< those of state_, until they are stored again
  std::uint64_t next_counter_ = 1;
  /// Bounds of state_ that survive a loss of power.
  struct Bounds {
    std::uint64_t send_next = 0;
    std::uint64_t receive_floor = 0;
  };
  Bounds syncing_;  ///< being written to the disk
  Bounds synced_;   ///< known to be there
  /// Highest counter accepted above the floor, since the start or the last change of epoch.
  std::optional<std::uint64_t> accepted_;
};

}  // namespace priamos::bus::radio
