#include "bus/radio/link_memory.hpp"

#include <utility>

namespace priamos::bus::radio {
namespace {

constexpr std::uint64_t kBlock = 256;
/// So many counters before its end the next block is begun: several seconds of a busy 9600-baud line.
constexpr std::uint64_t kReserve = 64;
/// A floor further ahead than this is not credible.
constexpr std::uint64_t kFarthestSkip = std::uint64_t{1} << 24;

}  // namespace

LinkMemory::LinkMemory(StateStore& store, const ChannelTable& table, const NonceSource& nonces,
                       const KeyChecks& keys)
    : store_(&store), channels_(table.size()) {
  const auto saved = store.Load();
  if (auto state = saved ? ParseLinkState(saved->bytes) : std::nullopt) state_ = std::move(*state);
  const bool fits = state_.table_hash == table.hash() && state_.send_event.size() == channels_ &&
                    state_.receive_event.size() == channels_ && state_.receive_known.size() == channels_;
  if (!fits || !saved->latest) {
    std::vector<StoredEvent> dropped = fits ? std::move(state_.events) : std::vector<StoredEvent>{};
    BeginAnew(table, nonces);
    state_.events = std::move(dropped);
    events_dropped_ = true;
  }
  ChooseKey(keys);
  next_counter_ = state_.send_next;
}

/// The key of the epoch is noted as soon as there is a choice; a state without it is one of the only key that
/// there was.
void LinkMemory::ChooseKey(const KeyChecks& keys) {
  const std::uint32_t noted = state_.key_check != 0 ? state_.key_check : keys.current;
  under_next_key_ = keys.next != 0 && noted == keys.next;
  if (!under_next_key_ && noted != keys.current) ForgetEpoch();
  if (keys.next != 0 || state_.key_check != 0) state_.key_check = under_next_key_ ? keys.next : keys.current;
}

void LinkMemory::ForgetEpoch() {
  state_.epoch = 0;
  state_.send_next = 1;
  state_.receive_floor = 0;
  state_.floor_exact = true;
}

/// Nothing to go on with: a new epoch is needed, and with it the other end learns of the new numbers. Those
/// of the other end's events are forgotten: of one byte each, they could be behind by so much that new ones
/// look old.
void LinkMemory::BeginAnew(const ChannelTable& table, const NonceSource& nonces) {
  state_ = LinkState{};
  state_.table_hash = table.hash();
  state_.receive_event.assign(channels_, 0);
  state_.receive_known.assign(channels_, 0);
  state_.send_event.assign(channels_, 0);
  state_.stream = static_cast<std::uint32_t>(nonces());
}

std::uint64_t LinkMemory::TakeCounter() {
  if (next_counter_ + kReserve >= state_.send_next) Reserve();
  if (next_counter_ >= synced_.send_next) AwaitSync();
  return next_counter_++;
}

void LinkMemory::SkipCounters(std::uint64_t floor) {
  if (floor >= next_counter_ && floor - next_counter_ < kFarthestSkip) next_counter_ = floor + 1;
}

void LinkMemory::NoteAccepted(std::uint64_t highest) {
  accepted_ = highest;
  if (highest + kReserve > state_.receive_floor) Reserve();
  if (highest > synced_.receive_floor) AwaitSync();
}

/// Both directions at once: else the one would wait for the disk on behalf of the other.
void LinkMemory::Reserve() {
  state_.send_next = next_counter_ + kBlock;
  if (accepted_) {
    state_.receive_floor = *accepted_ + kBlock;
    state_.floor_exact = false;
  }
  StartSync();
}

void LinkMemory::StartSync() {
  Save();
  store_->StartSync();
  syncing_ = {state_.send_next, state_.receive_floor};
}

void LinkMemory::AwaitSync() {
  store_->AwaitSync();
  synced_ = syncing_;
}

bool LinkMemory::ChangeEpoch(std::uint64_t epoch, std::uint32_t peer_stream) {
  const bool new_numbers = peer_stream != state_.peer_stream;
  state_.epoch = epoch;
  state_.peer_stream = peer_stream;
  state_.send_next = 1;
  state_.receive_floor = 0;
  state_.floor_exact = true;
  accepted_.reset();
  next_counter_ = 1;
  if (new_numbers) state_.receive_known.assign(channels_, 0);
  StartSync();
  AwaitSync();
  return new_numbers;
}

void LinkMemory::RestoreEvents(SendQueue& queue, std::vector<EventReceiver>& receivers) const {
  for (std::size_t i = 0; i < channels_; ++i) {
    queue.events(i) = EventSender(state_.send_event[i]);
    receivers[i] = EventReceiver(state_.receive_event[i], state_.receive_known[i] != 0);
  }
  for (const StoredEvent& e : state_.events) {
    if (e.channel >= channels_) continue;
    if (events_dropped_) {
      queue.CountRefused(e.channel);
      continue;
    }
    queue.events(e.channel).Restore({.first = e.first,
                                     .packed_at = FromUtime(e.packed_utime),
                                     .bits = e.bits,
                                     .packed = e.packed,
                                     .released = false});
  }
}

void LinkMemory::StoreEvents(const SendQueue& queue, const std::vector<EventReceiver>& receivers) {
  state_.events.clear();
  for (std::size_t i = 0; i < channels_; ++i) {
    const EventSender& sender = queue.events(i);
    state_.send_event[i] = sender.next();
    state_.receive_event[i] = receivers[i].next();
    state_.receive_known[i] = receivers[i].known() ? 1 : 0;
    for (const EventSender::Event& e : sender.events())
      state_.events.push_back({.channel = static_cast<std::uint8_t>(i),
                               .first = e.first,
                               .packed_utime = ToUtime(e.packed_at),
                               .bits = static_cast<std::uint32_t>(e.bits),
                               .packed = e.packed});
  }
  // No sync: after a loss of power an event may come twice or be lost with everything else on board.
  Save();
}

void LinkMemory::Close(std::uint64_t highest_accepted) {
  state_.send_next = next_counter_;
  if (accepted_) {
    state_.receive_floor = highest_accepted;
    state_.floor_exact = true;
  }
  StartSync();
  AwaitSync();
}

}  // namespace priamos::bus::radio
