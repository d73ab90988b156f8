#include "bus/radio/handshake.hpp"

#include <utility>

namespace priamos::bus::radio {
namespace {

/// While the ends agree.
constexpr Duration kRepeat{300'000};
/// While the link is down: lets another channel table be seen.
constexpr Duration kAnnounce{1'000'000};

}  // namespace

Handshake::Handshake(std::uint32_t table_hash, NonceSource nonces, bool floor_due, Time now,
                     std::size_t code_bytes)
    : table_hash_(table_hash),
      code_bytes_(code_bytes),
      agreement_(std::move(nonces)),
      limit_(now),
      // An end without an epoch asks at once; one with an epoch first gives its frames a chance.
      last_(now - kRepeat),
      floor_due_(floor_due) {}

Handshake::Proof Handshake::OnHello(const Hello& hello, bool heard) {
  ++received_;
  const bool same_table = hello.table_hash == table_hash_;
  const EpochAgreement::Change change = agreement_.OnHello(hello, same_table, heard);
  // The end that this one agreed with has the epoch when its data has come: its hello is an old one.
  const bool late = change.known && !switched_;
  const bool wanted = same_table || hello.need || !table_mismatch_;
  reply_due_ = reply_due_ || (change.reply && wanted && !late);
  if (change.fresh) {
    table_mismatch_ = !same_table;
    peer_code_bytes_ = hello.code_bytes;
  }
  return {.fresh = change.fresh, .agreed = change.agreed};
}

void Handshake::OnData() {
  agreement_.OnData();
  switched_ = false;
  floor_due_ = floor_waits_ = false;
  table_mismatch_ = false;
}

void Handshake::OnEpochChanged() {
  switched_ = true;
  floor_due_ = floor_waits_ = false;
}

bool Handshake::HelloDue(Reception reception, Time now) const {
  if (!limit_.Allows(now)) return false;
  if (reply_due_) return true;
  if (floor_waits_) return false;
  if (reception == Reception::kUnusable || switched_) return now - last_ >= kRepeat;
  return reception == Reception::kSilent && now - last_ >= kAnnounce;
}

Hello Handshake::Take(std::uint32_t stream, Reception reception, Time now) {
  Hello hello = agreement_.Compose(reception == Reception::kUnusable);
  hello.table_hash = table_hash_;
  hello.code_bytes = code_bytes_;
  hello.stream = stream;
  reply_due_ = false;
  floor_waits_ = floor_due_;
  last_ = now;
  limit_.Use(now);
  return hello;
}

void Handshake::CountOn(const Handshake& before) {
  received_ += before.received_;
  sent_ += before.sent_;
}

}  // namespace priamos::bus::radio
