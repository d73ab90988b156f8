#pragma once

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "test/bus/radio/link_pair.hpp"

namespace priamos::bus::radio {

/// Keeps an outgoing event channel full of numbered events of `bytes` bytes.
inline void KeepEventsWaiting(LinkPair& pair, LinkPair::End& end, std::size_t channel, std::size_t bytes,
                              int& number) {
  while (end.link->waiting(channel) < 40) {
    std::string text = std::to_string(number++) + ":";
    text.resize(bytes, 'x');
    end.link->Offer(channel, Text(text), pair.now);
  }
}

/// Messages that say themselves whether they arrived as they were sent: 4 bytes of number, the rest follows
/// from it.
inline std::vector<std::byte> NumberedMessage(std::uint32_t number, std::size_t bytes) {
  std::vector<std::byte> message(bytes);
  std::uint64_t state = number * 0x9E3779B97F4A7C15U + bytes;
  for (std::size_t i = 4; i < bytes; ++i) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    message[i] = static_cast<std::byte>(state >> 56);
  }
  std::memcpy(message.data(), &number, 4);
  return message;
}
inline std::uint32_t NumberOf(std::span<const std::byte> message) {
  std::uint32_t number = 0;
  std::memcpy(&number, message.data(), std::min<std::size_t>(4, message.size()));
  return number;
}

/// Frames as they were on the line, delimiter included.
inline std::vector<std::vector<std::byte>> FramesOf(const std::vector<std::byte>& wire) {
  std::vector<std::vector<std::byte>> frames(1);
  for (const std::byte b : wire) {
    frames.back().push_back(b);
    if (b == kDelimiter) frames.emplace_back();
  }
  frames.pop_back();
  return frames;
}

}  // namespace priamos::bus::radio
