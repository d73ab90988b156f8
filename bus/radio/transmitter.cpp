#include "bus/radio/transmitter.hpp"

#include <utility>

#include "bus/radio/frame/frame.hpp"

namespace priamos::bus::radio {
namespace {

/// A cut costs a delimiter; a frame with no more than this to go is faster finished.
constexpr std::size_t kNotWorthCutting = 2;
/// After such a silence a delimiter leads, so that what noise left in the receiver does not spoil the frame.
constexpr std::size_t kIdleBytes = 16;

}  // namespace

Transmitter::Transmitter(const LinkOptions& options, Time now)
    : pacer_(options.bytes_per_s, options.ahead_bytes, now),
      duty_(options.duty),
      datagrams_(options.datagrams),
      instant_(options.instant()),
      head_bytes_(options.HeadBytes()) {}

bool Transmitter::WorthCutting() const {
  return busy() && wire_.size() - next_ > kNotWorthCutting;
}

void Transmitter::Begin(std::vector<std::byte> wire, Time now) {
  wire_ = std::move(wire);
  next_ = 0;
  duty_.Use(now, pacer_.WireTime(head_bytes_ + wire_.size()));
  for (std::size_t i = 0; i < head_bytes_; ++i) pacer_.Use(now);
  if (!datagrams_ && pacer_.Idle(now) >= pacer_.WireTime(kIdleBytes)) wire_.insert(wire_.begin(), kDelimiter);
}

void Transmitter::Emit(Time now, std::vector<std::byte>& out) {
  do {
    Put(wire_[next_++], now, out);
  } while (datagrams_ && busy());
}

void Transmitter::Cut(Time now, std::vector<std::byte>& out) {
  // If nothing of it has left, it never was.
  if (next_ > 0) Put(kDelimiter, now, out);
  Drop();
}

void Transmitter::Drop() {
  wire_.clear();
  next_ = 0;
}

Duration Transmitter::OnTheWay(std::size_t bytes) const {
  return instant_ ? Duration::zero() : pacer_.WireTime(head_bytes_ + bytes);
}

Duration Transmitter::Occupies(std::size_t bytes) const {
  return pacer_.WireTime(bytes + (datagrams_ ? kDatagramHead : 0));
}

Time Transmitter::LeavesAt(std::size_t bytes, Time now) const {
  return instant_ ? now : pacer_.LeavesAt(head_bytes_ + bytes, now);
}

void Transmitter::Put(std::byte byte, Time now, std::vector<std::byte>& out) {
  out.push_back(byte);
  pacer_.Use(now);
  ++bytes_sent_;
}

}  // namespace priamos::bus::radio
