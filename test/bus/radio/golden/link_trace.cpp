#include "link_trace.hpp"

namespace priamos::bus::radio {

void Trace::Add(std::uint8_t byte) {
  digest_ = (digest_ ^ byte) * 0x100000001b3;
}

void Trace::Number(std::uint64_t value) {
  for (int i = 0; i < 8; ++i) Add(static_cast<std::uint8_t>(value >> (8 * i) & 0xFF));
}

void Trace::Bytes(std::span<const std::byte> bytes) {
  Number(bytes.size());
  for (const std::byte b : bytes) Add(std::to_integer<std::uint8_t>(b));
}

std::optional<SavedState> TracedStore::Load() {
  if (states_.empty()) return std::nullopt;
  return SavedState{.bytes = states_.back()};
}

void TracedStore::Save(std::span<const std::byte> state) {
  trace_.Number('S');
  trace_.Bytes(state);
  states_.emplace_back(state.begin(), state.end());
  if (states_.size() > 16) states_.pop_front();
}

}  // namespace priamos::bus::radio
