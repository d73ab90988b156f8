#include <nlohmann/json.hpp>

#include "bus/schema/json.hpp"
#include "bus/schema/walk.hpp"
#include "bus/wire/datagram.hpp"
#include "bus/wire/reassembler.hpp"
#include "bus/wire/sequence_tracker.hpp"
#include "fuzz_input.hpp"

namespace priamos::bus {
namespace {

/// The way of a datagram from the socket to a message: nothing points outside of it.
bool Receive(std::span<const std::byte> datagram, SequenceTracker& numbers) {
  std::uint32_t number = 0;
  std::string_view channel;
  std::span<const std::byte> bytes;
  if (!ParseDatagram(datagram, number, channel, bytes)) return false;
  Require(channel.size() + 1 + bytes.size() + 8 == datagram.size());
  numbers.Add(1, number);
  const Struct* type = FuzzSchema().Of(bytes);
  if (type != nullptr && Walk(*type, bytes)) ToJson(*type, bytes);
  return true;
}

}  // namespace
}  // namespace priamos::bus

/// The input is a series of datagrams, each with its length before it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace priamos::bus;
  auto rest = std::as_bytes(std::span(data, size));
  SequenceTracker numbers;
  Reassembler reassembler;
  Reassembler::Message message;
  std::uint64_t received = 0;
  while (rest.size() >= 2) {
    const std::size_t length =
        std::min<std::size_t>(ReadBigEndian<std::uint16_t>(rest.data()), rest.size() - 2);
    const auto datagram = rest.subspan(2, length);
    received += Receive(datagram, numbers);
    reassembler.Add(length % 3, datagram, message);
    rest = rest.subspan(2 + length);
  }
  Require(reassembler.held_bytes() <= 101 * size);
  Require(numbers.senders() <= 1);
  Require(numbers.lost() <= received * SequenceTracker::kLargestGap);
  return 0;
}
