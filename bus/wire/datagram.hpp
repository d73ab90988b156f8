#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace priamos::bus {

/// The first four bytes of an unfragmented LCM datagram, "LC02" (big endian).
inline constexpr std::uint32_t kShortMagic = 0x4c433032;

/// Longest name of a channel [bytes].
inline constexpr std::size_t kLongestChannel = 63;

/// One unfragmented LCM datagram: magic `LC02`, number (big endian, counted by the sender over all its
/// channels), channel (1 to 63 printable ASCII characters) with a zero behind it, message. False when it is
/// none; `channel` and `bytes` point into it.
bool ParseDatagram(std::span<const std::byte> datagram, std::uint32_t& number, std::string_view& channel,
                   std::span<const std::byte>& bytes);

/// Channel and what is behind its zero, as they follow LCM's headers. False when there is no such channel.
bool SplitChannel(std::span<const std::byte> rest, std::string_view& channel,
                  std::span<const std::byte>& bytes);

}  // namespace priamos::bus
