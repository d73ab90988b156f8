#include <array>

#include "bus/radio/link.hpp"
#include "bus/radio/link_state.hpp"
#include "fuzz_input.hpp"

// Whatever the line brings, and whatever an end with the right key may say. The first byte chooses.

namespace priamos::bus::radio {
namespace {

using bus::Require;

LinkChannel Channel(const char* name, Direction direction, ChannelClass channel_class, std::uint32_t bits) {
  LinkChannel c;
  c.name = name;
  c.direction = direction;
  c.channel_class = channel_class;
  c.fixed_bits = bits;
  c.max_bits = bits > 0 ? bits : 8 * (channel_class == ChannelClass::kEvent ? 1400 : 200);
  c.rate_hz = 0;
  if (channel_class == ChannelClass::kCommand) c.ttl = Duration(250'000);
  return c;
}

const ChannelTable& Table() {
  static const ChannelTable table = [] {
    std::vector<LinkChannel> channels{Channel("POSE", Direction::kUp, ChannelClass::kState, 40),
                                      Channel("TEXT", Direction::kUp, ChannelClass::kState, 0),
                                      Channel("FIX", Direction::kUp, ChannelClass::kEvent, 0),
                                      Channel("FLAG", Direction::kUp, ChannelClass::kEvent, 13),
                                      Channel("MOVE", Direction::kUp, ChannelClass::kCommand, 21),
                                      Channel("ORDER", Direction::kDown, ChannelClass::kEvent, 0)};
    channels[0].delta = {15, 13, 3, 9};
    channels[1].on_request = true;
    return ChannelTable(channels, false);
  }();
  return table;
}

constexpr LinkKey kKey{7};
const Time kStart = FromUtime(1'000'000'000);

/// What is read can be written, and read as the same.
void Bundle(std::span<const std::byte> bytes) {
  const ParsedBundle parsed = ParseBundle(Table(), Direction::kUp, bytes);
  BundleWriter once(Table());
  for (const BundleEntry& entry : parsed.entries) once.Write(entry);
  const ParsedBundle again = ParseBundle(Table(), Direction::kUp, once.bytes());
  Require(again.whole && again.entries.size() == parsed.entries.size());
  BundleWriter twice(Table());
  for (const BundleEntry& entry : again.entries) twice.Write(entry);
  Require(once.bytes() == twice.bytes());
}

void Cobs(std::span<const std::byte> bytes) {
  const auto encoded = CobsEncode(bytes);
  Require(std::find(encoded.begin(), encoded.end(), kDelimiter) == encoded.end());
  const auto decoded = CobsDecode(encoded);
  Require(decoded && std::equal(decoded->begin(), decoded->end(), bytes.begin(), bytes.end()));
  CobsDecode(bytes);
}

/// An end in an epoch that the fuzzer's frames belong to.
class Receiver {
 public:
  Receiver()
      : link_(
            Table(), Direction::kDown, kKey, {}, Remembering(),
            [](std::size_t, std::span<const std::byte> b, Time) {
              return std::optional(Packed{{b.begin(), b.end()}, 8 * b.size()});
            },
            [n = std::uint64_t{1}]() mutable { return n++; }, kStart) {}

  void Bytes(std::span<const std::byte> bytes) { Take(link_.Receive(bytes, now_)); }
  /// Frames with the right code; the pieces of `bytes`, each after its length, are their bundles.
  void Frames(std::span<const std::byte> bytes) {
    const FrameSealer sealer(FrameKeys(kKey), Direction::kUp, {Table().hash(), false});
    for (std::uint64_t counter = 1; !bytes.empty(); ++counter) {
      const std::size_t size =
          std::min<std::size_t>(std::to_integer<std::size_t>(bytes[0]) % 128, bytes.size() - 1);
      Take(link_.Receive(sealer.Seal(kEpoch, counter, CounterForm::kWhole, bytes.subspan(1, size)), now_));
      bytes = bytes.subspan(1 + size);
      now_ += Duration(20'000);
      link_.Step(now_);
    }
  }

 private:
  static constexpr std::uint64_t kEpoch = 99;
  StateStore& Remembering() {
    LinkState state;
    state.table_hash = Table().hash();
    state.epoch = kEpoch;
    state.send_event = state.receive_event = state.receive_known =
        std::vector<std::uint8_t>(Table().size(), 0);
    store_.Save(Serialise(state));
    return store_;
  }
  void Take(const std::vector<Delivery>& deliveries) {
    for (const Delivery& d : deliveries) {
      Require(Table().at(d.channel).direction == Direction::kUp);
      Require(d.packed.size() <= (Table().at(d.channel).max_bits + 7) / 8 + kSegmentBytes * kEventWindow);
    }
  }

  MemoryStore store_;
  LinkEndpoint link_;
  Time now_ = kStart;
};

}  // namespace
}  // namespace priamos::bus::radio

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace priamos::bus::radio;
  if (size == 0) return 0;
  const auto bytes = std::as_bytes(std::span(data, size)).subspan(1);
  switch (data[0] % 4) {
    case 0:
      Bundle(bytes);
      break;
    case 1:
      Cobs(bytes);
      break;
    case 2:
      Receiver().Bytes(bytes);
      break;
    default:
      Receiver().Frames(bytes);
  }
  return 0;
}
