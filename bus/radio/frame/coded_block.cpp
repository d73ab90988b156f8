#include "bus/radio/frame/coded_block.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <numeric>
#include <utility>

#include "bus/radio/frame/reed_solomon.hpp"

namespace priamos::bus::radio {
namespace {

constexpr std::size_t kBitsPerSymbol = 7;
/// Symbols of data in a block: for contents of 11, 14, 17, 21, 24, 28 and 34 bytes, a hello.
constexpr std::array<std::size_t, 7> kDataSymbols{13, 16, 20, 24, 28, 32, 39};
constexpr std::size_t kMaxEncodedBytes = kDataSymbols.back() + kParitySymbols;
constexpr std::byte kCodedBit{0x80};
/// In a block are at most so many bytes without the mark: more wrong symbols are not corrected.
constexpr std::size_t kMostUnmarked = kParitySymbols / 2;

using Symbols = std::vector<std::uint8_t>;

constexpr std::size_t ContentBytes(std::size_t data_symbols) {
  return data_symbols * kBitsPerSymbol / 8;
}

bool IsBlockLength(std::size_t bytes) {
  return std::any_of(kDataSymbols.begin(), kDataSymbols.end(),
                     [&](std::size_t data) { return data + kParitySymbols == bytes; });
}

bool LooksLikeBlock(std::span<const std::byte> received) {
  return std::count_if(received.begin(), received.end(), [](std::byte b) {
           return (b & kCodedBit) != kCodedBit;
         }) <= static_cast<std::ptrdiff_t>(kMostUnmarked);
}

/// The bits of bytes, most significant first, in symbols of 7; the last one is filled with zeros.
Symbols SymbolsOf(std::span<const std::byte> content) {
  Symbols symbols((8 * content.size() + kBitsPerSymbol - 1) / kBitsPerSymbol);
  for (std::size_t bit = 0; bit < 8 * content.size(); ++bit) {
    const unsigned value = std::to_integer<unsigned>(content[bit / 8]) >> (7 - bit % 8) & 1U;
    symbols[bit / kBitsPerSymbol] |=
        static_cast<std::uint8_t>(value << (kBitsPerSymbol - 1 - bit % kBitsPerSymbol));
  }
  return symbols;
}

std::vector<std::byte> BytesOf(std::span<const std::uint8_t> symbols) {
  std::vector<std::byte> content(ContentBytes(symbols.size()));
  for (std::size_t bit = 0; bit < 8 * content.size(); ++bit) {
    const unsigned value =
        unsigned{symbols[bit / kBitsPerSymbol]} >> (kBitsPerSymbol - 1 - bit % kBitsPerSymbol) & 1U;
    content[bit / 8] |= static_cast<std::byte>(value << (7 - bit % 8));
  }
  return content;
}

/// Symbols of bytes as they came. What is 0 is a byte whose end the receiver did not recognise.
Symbols Receive(std::span<const std::byte> received, std::vector<std::size_t>& missing) {
  Symbols word(received.size());
  for (std::size_t i = 0; i < received.size(); ++i) {
    word[i] = std::to_integer<std::uint8_t>(received[i] & ~kCodedBit);
    if (received[i] == std::byte{0}) missing.push_back(i);
  }
  return word;
}

/// The content of a word, and how many of its symbols differ from those received.
struct Corrected {
  std::vector<std::byte> content;
  std::size_t changed;
};

std::optional<Corrected> Correct(std::span<const std::byte> received) {
  std::vector<std::size_t> missing;
  const Symbols as_received = Receive(received, missing);
  Symbols word = as_received;
  if (!ReedSolomonCorrect(word, missing)) return std::nullopt;
  const auto same = std::inner_product(word.begin(), word.end(), as_received.begin(), std::size_t{0},
                                       std::plus<>(), std::equal_to<>());
  return Corrected{BytesOf(std::span(word).first(word.size() - kParitySymbols)), word.size() - same};
}

/// One byte is lost, nobody knows which: each place is tried, and the one with the fewest other errors taken.
std::optional<Corrected> CorrectShort(std::span<const std::byte> received) {
  std::optional<Corrected> best;
  for (std::size_t lost = 0; lost <= received.size(); ++lost) {
    std::vector<std::byte> filled(received.begin(), received.end());
    filled.insert(filled.begin() + static_cast<std::ptrdiff_t>(lost), std::byte{0});
    const auto found = Correct(filled);
    if (found && (!best || found->changed < best->changed)) best = found;
  }
  return best;
}

}  // namespace

std::size_t BlockBytes(std::size_t content_bytes) {
  for (const std::size_t data : kDataSymbols)
    if (content_bytes <= ContentBytes(data)) return ContentBytes(data);
  return 0;
}

std::size_t EncodedBlockBytes(std::size_t block_bytes) {
  return (8 * block_bytes + kBitsPerSymbol - 1) / kBitsPerSymbol + kParitySymbols;
}

std::vector<std::byte> EncodeBlock(std::span<const std::byte> content) {
  Symbols word = SymbolsOf(content);
  const auto parity = ReedSolomonParity(word);
  word.insert(word.end(), parity.begin(), parity.end());
  std::vector<std::byte> encoded(word.size());
  std::transform(word.begin(), word.end(), encoded.begin(),
                 [](std::uint8_t symbol) { return kCodedBit | std::byte{symbol}; });
  return encoded;
}

std::optional<std::vector<std::byte>> DecodeBlock(std::span<const std::byte> received) {
  if (!LooksLikeBlock(received)) return std::nullopt;
  std::optional<Corrected> found;
  if (IsBlockLength(received.size())) {
    found = Correct(received);
  } else if (IsBlockLength(received.size() + 1)) {
    found = CorrectShort(received);
  }
  if (!found) return std::nullopt;
  return std::move(found->content);
}

std::optional<BlockFinder::Found> BlockFinder::Push(std::byte byte, Time now) {
  bytes_.push_back({byte, now});
  if (bytes_.size() > kMaxEncodedBytes + 1) bytes_.pop_front();
  const std::size_t before = since_delimiter_++;
  std::optional<Found> found;
  if (byte == std::byte{0}) {
    since_delimiter_ = 0;
    found = AtDelimiter(before);
  } else if (IsBlockLength(before)) {
    found = LastBytes(before);  // the delimiter may be damaged, or lost
  }
  if (found) bytes_.clear();
  return found;
}

/// With a byte lost, `since_the_last` must be the length of the rest: trying every length would cost too
/// much.
std::optional<BlockFinder::Found> BlockFinder::AtDelimiter(std::size_t since_the_last) const {
  std::optional<Found> found = LastBytes(since_the_last);
  for (std::size_t i = 0; i < kDataSymbols.size() && !found; ++i)
    found = LastBytes(kDataSymbols[i] + kParitySymbols);
  return found;
}

/// The block of so many bytes before the last one.
std::optional<BlockFinder::Found> BlockFinder::LastBytes(std::size_t count) const {
  if (count + 1 > bytes_.size()) return std::nullopt;
  const auto first = bytes_.end() - 1 - static_cast<std::ptrdiff_t>(count);
  std::vector<std::byte> received(count);
  std::transform(first, bytes_.end() - 1, received.begin(), [](const Arrival& a) { return a.byte; });
  auto content = DecodeBlock(received);
  if (!content) return std::nullopt;
  return Found{.content = std::move(*content), .wire_bytes = count + 1, .first_byte = first->at};
}

}  // namespace priamos::bus::radio
