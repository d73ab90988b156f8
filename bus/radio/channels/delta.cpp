#include "bus/radio/channels/delta.hpp"

#include <algorithm>
#include <utility>

namespace priamos::bus::radio {
namespace {

constexpr int kNoSmallForm = 4;

/// Number of bits of a small difference: most values change by a few steps only, wide ones by a few more.
constexpr int SmallBits(int width) {
  return width / 3 + 1;
}

constexpr std::uint64_t Mask(int width) {
  return width >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << width) - 1;
}

void WriteValue(int width, std::uint64_t before, std::uint64_t value, BitWriter& out) {
  if (value == before) return out.Put(0, 1);
  out.Put(1, 1);
  if (width <= kNoSmallForm) return out.Put(value, width);
  // Modulo 2^width, from -2^(s-1) to 2^(s-1) - 1.
  const int small = SmallBits(width);
  const std::uint64_t shifted = (value - before + (std::uint64_t{1} << (small - 1))) & Mask(width);
  const bool fits = shifted <= Mask(small);
  out.Put(fits ? 0 : 1, 1);
  out.Put(fits ? shifted : value, fits ? small : width);
}

std::uint64_t ReadValue(int width, std::uint64_t before, BitReader& in) {
  if (in.Get(1) == 0) return before;
  if (width <= kNoSmallForm || in.Get(1) != 0) return in.Get(width);
  const int small = SmallBits(width);
  return (before + in.Get(small) - (std::uint64_t{1} << (small - 1))) & Mask(width);
}

}  // namespace

BitWriter EncodeDelta(const ValueWidths& widths, std::span<const std::byte> baseline,
                      std::span<const std::byte> message) {
  BitReader before(baseline), now(message);
  BitWriter out;
  for (const int width : widths) {
    const std::uint64_t old_value = before.Get(width);
    WriteValue(width, old_value, now.Get(width), out);
  }
  return out;
}

std::vector<std::byte> TakeDelta(const ValueWidths& widths, BitReader& in) {
  BitWriter taken;
  for (const int width : widths) {
    const bool changed = in.Get(1) != 0;
    taken.Put(changed ? 1 : 0, 1);
    if (!changed) continue;
    int bits = width;
    if (width > kNoSmallForm) {
      const bool whole = in.Get(1) != 0;
      taken.Put(whole ? 1 : 0, 1);
      if (!whole) bits = SmallBits(width);
    }
    taken.Put(in.Get(bits), bits);
  }
  return taken.Finish();
}

std::optional<std::vector<std::byte>> ApplyDelta(const ValueWidths& widths,
                                                 std::span<const std::byte> baseline,
                                                 std::span<const std::byte> delta) {
  BitReader before(baseline), in(delta);
  BitWriter message;
  for (const int width : widths) message.Put(ReadValue(width, before.Get(width), in), width);
  if (!in.ok() || !before.ok()) return std::nullopt;
  return message.Finish();
}

void MessageHistory::Note(std::uint64_t counter, std::vector<std::byte> packed) {
  while (!messages_.empty() && messages_.front().counter + kDeltaReach < counter) messages_.pop_front();
  messages_.push_back({counter, std::move(packed)});
}

const MessageHistory::Message* MessageHistory::Find(std::uint64_t counter) const {
  const auto at = std::find_if(messages_.begin(), messages_.end(),
                               [&](const Message& m) { return m.counter == counter; });
  return at == messages_.end() ? nullptr : &*at;
}

void DeltaSender::OnAcknowledged(std::uint64_t counter) {
  const MessageHistory::Message* message = sent_.Find(counter);
  if (message == nullptr || (baseline_ && baseline_->counter >= counter)) return;
  baseline_ = *message;
}

void DeltaSender::Forget() {
  sent_.Clear();
  baseline_.reset();
}

const MessageHistory::Message* DeltaSender::Baseline(std::uint64_t counter) const {
  if (!baseline_ || baseline_->counter >= counter || counter - baseline_->counter > kDeltaReach)
    return nullptr;
  return &*baseline_;
}

std::uint64_t BaselineCounter(std::uint64_t counter, std::uint8_t low_bits) {
  const std::uint64_t distance = (counter - low_bits) & kDeltaReach;
  return distance == 0 || distance >= counter ? 0 : counter - distance;
}

}  // namespace priamos::bus::radio
