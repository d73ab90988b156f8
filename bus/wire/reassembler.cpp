#include "bus/wire/reassembler.hpp"

#include <algorithm>

#include "bus/schema/big_endian.hpp"
#include "bus/wire/datagram.hpp"

namespace priamos::bus {
namespace {

constexpr std::uint32_t kMagic = 0x4c433033;  // "LC03"

}  // namespace

std::optional<FragmentHeader> FragmentHeader::Read(std::span<const std::byte> datagram) {
  if (datagram.size() <= kBytes || ReadBigEndian<std::uint32_t>(datagram.data()) != kMagic)
    return std::nullopt;
  const std::byte* at = datagram.data();
  const FragmentHeader header{ReadBigEndian<std::uint32_t>(at + 4), ReadBigEndian<std::uint32_t>(at + 8),
                              ReadBigEndian<std::uint32_t>(at + 12), ReadBigEndian<std::uint16_t>(at + 16),
                              ReadBigEndian<std::uint16_t>(at + 18)};
  const bool possible = header.fragments >= 2 && header.fragment < header.fragments &&
                        header.offset <= header.message_bytes &&
                        header.message_bytes <= Reassembler::kMostBytes;
  return possible ? std::optional(header) : std::nullopt;
}

std::array<std::byte, FragmentHeader::kBytes> FragmentHeader::Write() const {
  std::array<std::byte, kBytes> header;
  WriteBigEndian(header.data(), kMagic);
  WriteBigEndian(header.data() + 4, number);
  WriteBigEndian(header.data() + 8, message_bytes);
  WriteBigEndian(header.data() + 12, offset);
  WriteBigEndian(header.data() + 16, fragment);
  WriteBigEndian(header.data() + 18, fragments);
  return header;
}

Reassembler::Partial& Reassembler::PartialOf(std::uint64_t sender) {
  const auto [at, added] = partials_.try_emplace(sender);
  if (added && partials_.size() > kMostSenders) {
    at->second.heard = datagrams_;
    const auto oldest =
        std::min_element(partials_.begin(), partials_.end(),
                         [](const auto& x, const auto& y) { return x.second.heard < y.second.heard; });
    Drop(oldest->second);
    partials_.erase(oldest);
  }
  return partials_.at(sender);
}

void Reassembler::Drop(Partial& partial) {
  if (partial.pieces.empty()) return;
  ++abandoned_;
  for (const auto& [n, piece] : partial.pieces) held_bytes_ -= piece.Cost();
  partial.pieces.clear();
}

/// The least recently heard ones go first.
void Reassembler::MakeRoom(std::size_t bytes) {
  while (held_bytes_ + bytes > kMostBytes) {
    Partial* oldest = nullptr;
    for (auto& [sender, partial] : partials_)
      if (!partial.pieces.empty() && (oldest == nullptr || partial.heard < oldest->heard)) oldest = &partial;
    Drop(*oldest);
  }
}

/// The pieces lie in the message without gap or overlap, the first one behind the channel.
bool Reassembler::Join(const Partial& partial, Message& message) {
  std::span<const std::byte> data;
  std::string_view channel;
  if (!SplitChannel(partial.pieces.at(0).bytes, channel, data)) return false;
  message.channel = channel;
  message.bytes.assign(data.begin(), data.end());
  for (auto piece = std::next(partial.pieces.begin()); piece != partial.pieces.end(); ++piece) {
    if (piece->second.offset != message.bytes.size()) return false;
    message.bytes.insert(message.bytes.end(), piece->second.bytes.begin(), piece->second.bytes.end());
  }
  return message.bytes.size() == partial.header.message_bytes;
}

Reassembler::Result Reassembler::Finish(Partial& partial, Message& message) {
  const bool whole = Join(partial, message);
  Drop(partial);
  if (!whole) return Result::kMalformed;
  --abandoned_;
  partial.finished = partial.header.number;
  return Result::kComplete;
}

Reassembler::Result Reassembler::Add(std::uint64_t sender, std::span<const std::byte> datagram,
                                     Message& message) {
  const auto header = FragmentHeader::Read(datagram);
  if (!header) return Result::kMalformed;
  Partial& partial = PartialOf(sender);
  partial.heard = ++datagrams_;
  if (partial.finished == header->number) return Result::kWaiting;  // once more what is whole already
  const FragmentHeader& begun = partial.header;
  const bool begins = partial.pieces.empty() || begun.number != header->number ||
                      begun.fragments != header->fragments || begun.message_bytes != header->message_bytes;
  if (begins) {
    Drop(partial);
    partial.header = *header;
  }
  const auto data = datagram.subspan(FragmentHeader::kBytes);
  Piece piece{header->offset, {data.begin(), data.end()}};
  MakeRoom(piece.Cost());
  const auto [at, added] = partial.pieces.try_emplace(header->fragment, std::move(piece));
  if (added) held_bytes_ += at->second.Cost();
  if (partial.pieces.size() == begun.fragments) return Finish(partial, message);
  return begins ? Result::kBegun : Result::kWaiting;
}

}  // namespace priamos::bus
