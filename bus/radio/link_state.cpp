#include "bus/radio/link_state.hpp"

#include <sodium.h>

#include <algorithm>
#include <array>

namespace priamos::bus::radio {
namespace {

constexpr std::uint32_t kMagic = 0x334B4C50;         // "PLK3"
constexpr std::uint32_t kMagicWithKey = 0x344B4C50;  // "PLK4": the same with the key of the epoch behind
constexpr std::size_t kChecksumBytes = 16;

class Writer {
 public:
  void Number(std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) bytes_.push_back(static_cast<std::byte>(value >> (8 * i) & 0xFF));
  }
  void Numbers(std::span<const std::uint8_t> values) {
    Number(values.size(), 2);
    for (const std::uint8_t v : values) Number(v, 1);
  }
  void Bytes(std::span<const std::byte> values) {
    Number(values.size(), 4);
    bytes_.insert(bytes_.end(), values.begin(), values.end());
  }
  std::vector<std::byte>& bytes() { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  std::uint64_t Number(std::size_t bytes) {
    if (bytes_.size() < bytes) {
      ok_ = false;
      return 0;
    }
    std::uint64_t value = 0;
    for (std::size_t i = bytes; i-- > 0;) value = value << 8 | std::to_integer<std::uint64_t>(bytes_[i]);
    bytes_ = bytes_.subspan(bytes);
    return value;
  }
  std::vector<std::byte> Bytes(std::size_t size) {
    if (bytes_.size() < size) {
      ok_ = false;
      return {};
    }
    const auto part = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return {part.begin(), part.end()};
  }
  std::vector<std::uint8_t> Numbers() {
    std::vector<std::uint8_t> values;
    for (const std::byte b : Bytes(Number(2))) values.push_back(std::to_integer<std::uint8_t>(b));
    return values;
  }
  bool ok() const { return ok_; }
  bool at_end() const { return bytes_.empty(); }

 private:
  std::span<const std::byte> bytes_;
  bool ok_ = true;
};

std::array<std::byte, kChecksumBytes> Checksum(std::span<const std::byte> bytes) {
  std::array<std::byte, kChecksumBytes> sum{};
  crypto_generichash(reinterpret_cast<unsigned char*>(sum.data()), sum.size(),
                     reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), nullptr, 0);
  return sum;
}

}  // namespace

std::vector<std::byte> Serialise(const LinkState& state) {
  Writer w;
  w.Number(state.key_check != 0 ? kMagicWithKey : kMagic, 4);
  w.Number(state.table_hash, 4);
  w.Number(state.epoch, 8);
  w.Number(state.send_next, 8);
  w.Number(state.receive_floor, 8);
  w.Number(state.floor_exact ? 1 : 0, 1);
  w.Number(state.stream, 4);
  w.Number(state.peer_stream, 4);
  w.Numbers(state.send_event);
  w.Numbers(state.receive_event);
  w.Numbers(state.receive_known);
  w.Number(state.events.size(), 2);
  for (const StoredEvent& e : state.events) {
    w.Number(e.channel, 1);
    w.Number(e.first, 1);
    w.Number(static_cast<std::uint64_t>(e.packed_utime), 8);
    w.Number(e.bits, 4);
    w.Bytes(e.packed);
  }
  if (state.key_check != 0) w.Number(state.key_check, 4);
  const auto sum = Checksum(w.bytes());
  w.bytes().insert(w.bytes().end(), sum.begin(), sum.end());
  return std::move(w.bytes());
}

std::optional<LinkState> ParseLinkState(std::span<const std::byte> bytes) {
  if (bytes.size() < kChecksumBytes) return std::nullopt;
  const auto body = bytes.first(bytes.size() - kChecksumBytes);
  const auto sum = Checksum(body);
  if (!std::equal(sum.begin(), sum.end(), bytes.last(kChecksumBytes).begin())) return std::nullopt;

  Reader r(body);
  LinkState state;
  const std::uint64_t magic = r.Number(4);
  if (magic != kMagic && magic != kMagicWithKey) return std::nullopt;
  state.table_hash = static_cast<std::uint32_t>(r.Number(4));
  state.epoch = r.Number(8);
  state.send_next = r.Number(8);
  state.receive_floor = r.Number(8);
  state.floor_exact = r.Number(1) != 0;
  state.stream = static_cast<std::uint32_t>(r.Number(4));
  state.peer_stream = static_cast<std::uint32_t>(r.Number(4));
  state.send_event = r.Numbers();
  state.receive_event = r.Numbers();
  state.receive_known = r.Numbers();
  const std::uint64_t n = r.Number(2);
  for (std::uint64_t i = 0; i < n && r.ok(); ++i) {
    StoredEvent e;
    e.channel = static_cast<std::uint8_t>(r.Number(1));
    e.first = static_cast<std::uint8_t>(r.Number(1));
    e.packed_utime = static_cast<std::int64_t>(r.Number(8));
    e.bits = static_cast<std::uint32_t>(r.Number(4));
    e.packed = r.Bytes(r.Number(4));
    if (e.bits > e.packed.size() * 8) return std::nullopt;
    state.events.push_back(std::move(e));
  }
  if (magic == kMagicWithKey) state.key_check = static_cast<std::uint32_t>(r.Number(4));
  if (!r.ok() || !r.at_end()) return std::nullopt;
  return state;
}

}  // namespace priamos::bus::radio
