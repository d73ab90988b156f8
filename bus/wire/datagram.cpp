#include "bus/wire/datagram.hpp"

#include <algorithm>

#include "bus/schema/big_endian.hpp"

namespace priamos::bus {
namespace {

constexpr std::size_t kHeaderBytes = 8;

}  // namespace

bool SplitChannel(std::span<const std::byte> rest, std::string_view& channel,
                  std::span<const std::byte>& bytes) {
  const auto name = rest.first(std::min(rest.size(), kLongestChannel + 1));
  const auto end = std::find(name.begin(), name.end(), std::byte{0});
  // Names that nobody could type or read back from a log are nonsense or an attack.
  const auto printable = [](std::byte b) { return b >= std::byte{0x20} && b < std::byte{0x7f}; };
  if (end == name.end() || end == name.begin() || !std::all_of(name.begin(), end, printable)) return false;
  channel = {reinterpret_cast<const char*>(rest.data()), static_cast<std::size_t>(end - name.begin())};
  bytes = rest.subspan(channel.size() + 1);
  return true;
}

bool ParseDatagram(std::span<const std::byte> datagram, std::uint32_t& number, std::string_view& channel,
                   std::span<const std::byte>& bytes) {
  if (datagram.size() <= kHeaderBytes || ReadBigEndian<std::uint32_t>(datagram.data()) != kShortMagic)
    return false;
  number = ReadBigEndian<std::uint32_t>(datagram.data() + 4);
  return SplitChannel(datagram.subspan(kHeaderBytes), channel, bytes);
}

}  // namespace priamos::bus
