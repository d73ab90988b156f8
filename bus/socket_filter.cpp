#include "bus/socket_filter.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <linux/filter.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace priamos::bus {
namespace {

constexpr std::uint32_t kShortMagic = 0x4c433032;  // "LC02"
constexpr int kUdpHeaderBytes = 8;                 // a socket filter on UDP sees the UDP header first

bool IsReceiverOn(int fd, std::uint16_t port) {
  int type = 0;
  socklen_t type_size = sizeof type;
  if (getsockopt(fd, SOL_SOCKET, SO_TYPE, &type, &type_size) != 0 || type != SOCK_DGRAM) return false;
  sockaddr_in address{};
  socklen_t address_size = sizeof address;
  if (getsockname(fd, reinterpret_cast<sockaddr*>(&address), &address_size) != 0) return false;
  return address.sin_family == AF_INET && ntohs(address.sin_port) == port;
}

std::vector<int> OwnDescriptors() {
  std::vector<int> fds;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    const std::string name = entry.path().filename();
    int fd = -1;
    std::from_chars(name.data(), name.data() + name.size(), fd);
    if (fd >= 0) fds.push_back(fd);
  }
  return fds;
}

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

int FilterFragments(std::uint16_t port) {
  std::array<sock_filter, 4> code{{
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kUdpHeaderBytes),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kShortMagic, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, 0xffffffff),
      BPF_STMT(BPF_RET | BPF_K, 0),
  }};
  const sock_fprog program{static_cast<unsigned short>(code.size()), code.data()};
  int filtered = 0;
  for (const int fd : OwnDescriptors()) {
    if (!IsReceiverOn(fd, port)) continue;
    if (setsockopt(fd, SOL_SOCKET, SO_ATTACH_FILTER, &program, sizeof program) != 0)
      throw std::runtime_error(fmt::format("socket filter on port {}: {}", port, std::strerror(errno)));
    ++filtered;
  }
  return filtered;
}

}  // namespace priamos::bus
