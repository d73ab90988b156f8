#include "test/bench/radio/flood/radio_flood.hpp"

#include <arpa/inet.h>
#include <netinet/ip.h>
#include <netinet/udp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <cstring>
#include <deque>
#include <random>
#include <stdexcept>
#include <vector>

#include "test/bench/radio/flood/eavesdropper.hpp"

namespace priamos {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::size_t kHeads = sizeof(iphdr) + sizeof(udphdr);
constexpr std::size_t kMostConnections = 500;

/// How many are due since the last call.
class Pace {
 public:
  explicit Pace(double per_s) : per_s_(per_s) {}
  std::uint64_t Due() {
    const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
    const auto all = static_cast<std::uint64_t>(elapsed_s * per_s_);
    const std::uint64_t due = all - given_;
    given_ = all;
    return due;
  }

 private:
  double per_s_;
  Clock::time_point start_ = Clock::now();
  std::uint64_t given_ = 0;
};

int Open(int family, int type, int protocol) {
  const int fd = socket(family, type | SOCK_CLOEXEC, protocol);
  if (fd < 0) throw std::runtime_error("flood: expected a network of its own");
  return fd;
}

sockaddr_in Local(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

/// A frame of random bytes: one COBS block and the delimiter.
std::vector<std::uint8_t> RandomFrame(std::size_t size, bool hello, std::mt19937& random) {
  std::vector<std::uint8_t> frame(size);
  for (std::uint8_t& b : frame) b = static_cast<std::uint8_t>(1 + random() % 255);
  frame[0] = static_cast<std::uint8_t>(size - 1);
  frame[1] = hello ? 0x81 : static_cast<std::uint8_t>(1 + random() % 127);
  frame.back() = 0;
  return frame;
}

std::vector<std::uint8_t> Packet(std::uint16_t source, std::uint16_t port,
                                 const std::vector<std::uint8_t>& payload) {
  iphdr ip{};
  ip.version = 4;
  ip.ihl = 5;
  ip.ttl = 64;
  ip.id = htons(kFloodMark);
  ip.protocol = IPPROTO_UDP;
  ip.tot_len = htons(static_cast<std::uint16_t>(kHeads + payload.size()));
  ip.saddr = ip.daddr = htonl(INADDR_LOOPBACK);
  udphdr udp{};
  udp.source = htons(source);
  udp.dest = htons(port);
  udp.len = htons(static_cast<std::uint16_t>(sizeof udp + payload.size()));
  std::vector<std::uint8_t> packet(kHeads);
  std::memcpy(packet.data(), &ip, sizeof ip);
  std::memcpy(packet.data() + sizeof ip, &udp, sizeof udp);
  packet.insert(packet.end(), payload.begin(), payload.end());
  return packet;
}

}  // namespace

Flood::Flood(const FloodOptions& options) : options_(options) {
  const bool connects = options.kind == "silent" || options.kind == "garbage";
  thread_ = std::thread([this, connects] { connects ? Connect() : SendDatagrams(); });
}

Flood::~Flood() {
  stop_ = true;
  thread_.join();
}

std::vector<std::uint8_t> Flood::Payload(const std::vector<std::uint8_t>& newest,
                                         std::mt19937& random) const {
  if (options_.kind == "replay") return options_.recorded[random() % options_.recorded.size()];
  if (newest.size() > 8) {
    std::vector<std::uint8_t> payload = newest;
    payload[1] = static_cast<std::uint8_t>(payload[1] % 127 + 1);
    payload[payload.size() - 2] = static_cast<std::uint8_t>(1 + random() % 255);
    return payload;
  }
  return options_.kind == "hello" ? RandomFrame(36, true, random)
                                  : RandomFrame(options_.kind == "short" ? 9 : 45, false, random);
}

void Flood::SendDatagrams() {
  std::mt19937 random{1};
  const int fd = Open(AF_INET, SOCK_RAW, IPPROTO_RAW);
  const sockaddr_in to = Local(options_.port);
  Eavesdropper wire(options_.port);
  for (Pace pace(options_.per_s); !stop_; std::this_thread::sleep_for(std::chrono::microseconds(500))) {
    std::vector<std::uint8_t> newest = options_.kind == "next" ? wire.Newest() : std::vector<std::uint8_t>{};
    for (std::uint64_t due = pace.Due(); due > 0; --due) {
      const auto source =
          options_.source != 0 ? options_.source : static_cast<std::uint16_t>(random() | 1024);
      const auto packet = Packet(source, options_.port, Payload(newest, random));
      sent_ += sendto(fd, packet.data(), packet.size(), MSG_DONTWAIT, reinterpret_cast<const sockaddr*>(&to),
                      sizeof to) > 0
                   ? 1
                   : 0;
    }
  }
  close(fd);
}

void Flood::Connect() {
  const sockaddr_in to = Local(options_.port);
  std::vector<std::uint8_t> nonsense(512, 7);
  for (std::size_t i = 9; i < nonsense.size(); i += 10) nonsense[i] = 0;
  std::deque<int> open;
  for (Pace pace(options_.per_s); !stop_; std::this_thread::sleep_for(std::chrono::milliseconds(2))) {
    for (std::uint64_t due = pace.Due(); due > 0; --due) {
      open.push_back(Open(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0));
      connect(open.back(), reinterpret_cast<const sockaddr*>(&to), sizeof to);
      ++sent_;
      if (open.size() <= kMostConnections) continue;
      close(open.front());
      open.pop_front();
    }
    if (options_.kind == "garbage")
      for (const int fd : open) (void)!send(fd, nonsense.data(), nonsense.size(), MSG_NOSIGNAL);
  }
  for (const int fd : open) close(fd);
}

}  // namespace priamos
