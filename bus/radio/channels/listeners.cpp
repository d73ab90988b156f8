#include "bus/radio/channels/listeners.hpp"

namespace priamos::bus::radio {
namespace {

constexpr Duration kRepeat{2'000'000};
/// Three repetitions: two may get lost.
constexpr Duration kMemory{6'000'000};

}  // namespace

void Listeners::Listen(std::size_t channel, bool listening) {
  const std::uint64_t before = here_;
  const std::uint64_t bit = std::uint64_t{1} << channel;
  here_ = listening ? here_ | bit : here_ & ~bit;
  if (here_ != before) changed_ = true;
}

bool Listeners::Due(Time now) const {
  return changed_ || (here_ != 0 && now - sent_at_.value_or(Time{}) >= kRepeat);
}

ListenEntry Listeners::Take(Time now) {
  changed_ = false;
  sent_at_ = now;
  return {here_};
}

void Listeners::OnListen(const ListenEntry& listen, Time now) {
  if (listen.channels != 0) believed_until_ = now + kMemory;
}

bool Listeners::TakeExpiry(Time now) {
  if (!believed_until_ || now < *believed_until_) return false;
  believed_until_.reset();
  return true;
}

}  // namespace priamos::bus::radio
