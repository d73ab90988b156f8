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

std::optional<EpochAgreement::Pair> Handshake::OnHello(const Hello& hello) {
  ++received_;
  peer_code_bytes_ = hello.code_bytes;
  table_mismatch_ = hello.table_hash != table_hash_;
  if (table_mismatch_) return std::nullopt;
  const EpochAgreement::Change change = agreement_.OnHello(hello);
  reply_due_ = reply_due_ || change.reply;
  return change.agreed;
}

void Handshake::OnData() {
  switched_ = false;
  floor_due_ = false;
  table_mismatch_ = false;
}

void Handshake::OnEpochChanged() {
  switched_ = true;
  floor_due_ = false;
}

bool Handshake::HelloDue(Reception reception, Time now) const {
  if (!limit_.Allows(now)) return false;
  if (reply_due_) return true;
  if (reception == Reception::kUnusable || switched_) return now - last_ >= kRepeat;
  return reception == Reception::kSilent && now - last_ >= kAnnounce;
}

Hello Handshake::Take(std::uint32_t stream, Reception reception, Time now) {
  Hello hello = agreement_.Compose(reception == Reception::kUnusable);
  hello.table_hash = table_hash_;
  hello.code_bytes = code_bytes_;
  hello.stream = stream;
  reply_due_ = false;
  last_ = now;
  limit_.Use(now);
  return hello;
}

}  // namespace priamos::bus::radio
