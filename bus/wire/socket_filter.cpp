#include "bus/wire/socket_filter.hpp"

#include <fmt/format.h>
#include <linux/filter.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "bus/wire/datagram.hpp"

namespace priamos::bus {
namespace {

constexpr int kUdpHeaderBytes = 8;  // a socket filter on UDP sees the UDP header first

}  // namespace

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
