#include "bus/wire/socket_filter.hpp"

#include <fmt/format.h>
#include <linux/filter.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <stdexcept>

namespace priamos::bus {
namespace {

constexpr std::uint32_t kShortMagic = 0x4c433032;  // "LC02"
constexpr int kUdpHeaderBytes = 8;                 // a socket filter on UDP sees the UDP header first

}  // namespace

std::uint16_t PortOf(const std::string& url) {
  constexpr std::uint16_t kLcmDefault = 7667;
  const auto authority = url.find("://");
  if (authority == std::string::npos) return kLcmDefault;
  const auto end = url.find('?');
  const auto colon = url.find(':', authority + 3);
  if (colon == std::string::npos || colon > end) return kLcmDefault;
  std::uint16_t port = kLcmDefault;
  std::from_chars(url.data() + colon + 1, url.data() + std::min(end, url.size()), port);
  return port;
}

void FilterSocket(int fd) {
  std::array<sock_filter, 4> code{{
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kUdpHeaderBytes),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kShortMagic, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, 0xffffffff),
      BPF_STMT(BPF_RET | BPF_K, 0),
  }};
  const sock_fprog program{static_cast<unsigned short>(code.size()), code.data()};
  if (setsockopt(fd, SOL_SOCKET, SO_ATTACH_FILTER, &program, sizeof program) != 0)
    throw std::runtime_error(fmt::format("socket filter: {}", std::strerror(errno)));
}

}  // namespace priamos::bus
