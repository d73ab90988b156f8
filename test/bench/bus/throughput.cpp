#include "test/bench/bus/throughput.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <thread>
#include <vector>

#include "bus/wire/lcm_bus.hpp"

namespace priamos::bench {
namespace {

constexpr const char* kBus = "udpm://239.255.76.67:7706?ttl=0";
constexpr int kQuiet_ms = 300;

/// Calls `receive` while something comes, or more is to come.
void Receive(int fd, const std::atomic<bool>& ended, const std::function<void()>& receive) {
  pollfd waiting{fd, POLLIN, 0};
  while (poll(&waiting, 1, kQuiet_ms) == 1 || !ended) receive();
}

/// Sends for so long, while another thread receives what comes to `fd`.
void Flood(Throughput& result, double seconds, int fd, const std::function<void()>& receive,
           const std::function<bool()>& send) {
  std::atomic<bool> ended = false;
  std::thread listening([&] { Receive(fd, ended, receive); });
  const auto start = std::chrono::steady_clock::now();
  const auto passed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  for (; passed() < seconds; result.seconds = passed())
    for (int i = 0; i < 100; ++i) result.sent += send() ? 1 : 0;
  // A loss shows by the number behind it: one more message when it is quiet.
  std::this_thread::sleep_for(std::chrono::milliseconds(kQuiet_ms / 2));
  result.sent += send() ? 1 : 0;
  ended = true;
  listening.join();
}

/// A sending and a receiving socket of a group, the receiver with as much room as that of the bus.
class RawSockets {
 public:
  RawSockets() {
    inet_pton(AF_INET, "239.255.76.67", &group_.sin_addr);
    group_.sin_family = AF_INET;
    group_.sin_port = htons(7707);
    const int on = 1, room = kRoomBytes;
    const ip_mreq membership{group_.sin_addr, {htonl(INADDR_ANY)}};
    setsockopt(in_, SOL_SOCKET, SO_RCVBUF, &room, sizeof room);
    const bool open = setsockopt(in_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) == 0 &&
                      bind(in_, reinterpret_cast<const sockaddr*>(&group_), sizeof group_) == 0 &&
                      setsockopt(in_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership) == 0;
    if (!open) throw std::runtime_error("no multicast; next: scripts/in-private-network");
  }
  ~RawSockets() {
    close(in_);
    close(out_);
  }
  RawSockets(const RawSockets&) = delete;
  RawSockets& operator=(const RawSockets&) = delete;

  int fd() const { return in_; }
  bool Send(const std::vector<char>& bytes) const {
    return sendto(out_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&group_),
                  sizeof group_) == static_cast<ssize_t>(bytes.size());
  }
  /// Takes all that waits; returns how many.
  std::uint64_t Receive() const {
    char bytes[65536];
    std::uint64_t heard = 0;
    while (recv(in_, bytes, sizeof bytes, MSG_DONTWAIT) > 0) ++heard;
    return heard;
  }

 private:
  static constexpr int kRoomBytes = 4 << 20;
  sockaddr_in group_{};
  int in_ = socket(AF_INET, SOCK_DGRAM, 0), out_ = socket(AF_INET, SOCK_DGRAM, 0);
};

}  // namespace

Throughput SendFlatOut(std::size_t bytes, double seconds) {
  Throughput result;
  bus::LcmBus receiver(kBus), sender(kBus);
  receiver.Subscribe("FLOOD", [&](std::string_view, std::span<const std::byte>) { ++result.heard; });
  const std::vector<std::byte> message(bytes);
  Flood(
      result, seconds, receiver.fd(), [&] { receiver.Drain(); },
      [&] { return sender.Publish("FLOOD", message); });
  result.lost = receiver.lost();
  return result;
}

Throughput SendRawFlatOut(std::size_t bytes, double seconds) {
  Throughput result;
  const RawSockets sockets;
  const std::vector<char> datagram(bytes);
  Flood(
      result, seconds, sockets.fd(), [&] { result.heard += sockets.Receive(); },
      [&] { return sockets.Send(datagram); });
  return result;
}

}  // namespace priamos::bench
