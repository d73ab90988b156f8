#include "test/bench/radio/flood/eavesdropper.hpp"

#include <arpa/inet.h>
#include <linux/if_ether.h>
#include <netinet/ip.h>
#include <netinet/udp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <stdexcept>

namespace priamos {
namespace {

constexpr std::size_t kHeads = sizeof(iphdr) + sizeof(udphdr);
constexpr std::size_t kDataKept = 64;

/// The first byte behind that of COBS has its highest bit set in a hello alone (PROTOCOL.md).
bool IsHello(const std::vector<std::uint8_t>& frame) {
  return frame.size() > 2 && frame[0] < 0x80 && (frame[1] & 0x80) != 0;
}

}  // namespace

Eavesdropper::Eavesdropper(std::uint16_t port)
    : port_(port), fd_(socket(AF_PACKET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, htons(ETH_P_IP))) {
  if (fd_ < 0) throw std::runtime_error("flood: expected a network of its own");
}

Eavesdropper::~Eavesdropper() {
  close(fd_);
}

void Eavesdropper::Listen() {
  std::array<std::uint8_t, 2048> packet;
  for (ssize_t n = 0; (n = recv(fd_, packet.data(), packet.size(), 0)) > 0;)
    Take(std::span(packet).first(static_cast<std::size_t>(n)));
}

std::vector<std::uint8_t> Eavesdropper::Newest() {
  Listen();
  return newest_;
}

std::vector<std::vector<std::uint8_t>> Eavesdropper::Recorded() {
  Listen();
  std::vector<std::vector<std::uint8_t>> all = hellos_;
  all.insert(all.end(), data_.begin(), data_.end());
  return all;
}

void Eavesdropper::Take(std::span<const std::uint8_t> packet) {
  if (packet.size() <= kHeads + 2) return;
  iphdr ip;
  udphdr udp;
  std::memcpy(&ip, packet.data(), sizeof ip);
  std::memcpy(&udp, packet.data() + sizeof ip, sizeof udp);
  if (ip.protocol != IPPROTO_UDP || ip.id == htons(kFloodMark) || udp.dest != htons(port_)) return;
  newest_.assign(packet.begin() + kHeads, packet.end());
  if (IsHello(newest_)) return hellos_.push_back(newest_);
  data_.push_back(newest_);
  if (data_.size() > kDataKept) data_.pop_front();
}

}  // namespace priamos
