#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace priamos {

/// A browser's end of one TCP connection, as rude as a test likes. It blocks for nothing: whoever waits turns
/// the server in `turn`.
class WebClient {
 public:
  WebClient(int port, std::function<void()> turn)
      : turn_(std::move(turn)), fd_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int on = 1;
    setsockopt(fd_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);  // as browsers do
    connected_ = connect(fd_, reinterpret_cast<sockaddr*>(&to), sizeof to) == 0;
  }
  ~WebClient() { Close(); }
  WebClient(const WebClient&) = delete;
  WebClient& operator=(const WebClient&) = delete;

  void Close() {
    if (fd_ >= 0) close(fd_);
    fd_ = -1;
  }
  bool Say(const std::string& bytes) {
    return connected_ &&
           send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
  }
  /// What has come after waiting until `done` holds of it, the end of the connection, or 2 s.
  std::string Hear(const std::function<bool(const std::string&)>& done) {
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(2);
    while (!done(heard_) && !ended_ && std::chrono::steady_clock::now() < give_up) Take(5);
    return heard_;
  }
  std::string HearAll() {
    return Hear([](const std::string&) { return false; });
  }
  bool ended() {
    Take(0);
    return ended_;
  }
  void Forget() { heard_.clear(); }

  /// Opens a WebSocket; false when the server refuses.
  bool Upgrade(const std::string& origin, const std::string& target = "/socket",
               const std::string& host = "localhost", const std::string& more = "") {
    Say("GET " + target + " HTTP/1.1\r\nHost: " + host + "\r\nOrigin: " + origin +
        "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n" + more +
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
    head_ = Hear([](const std::string& text) { return text.find("\r\n\r\n") != text.npos; });
    head_.erase(std::min(head_.find("\r\n\r\n") + 4, head_.size()));
    heard_.erase(0, head_.size());
    return head_.starts_with("HTTP/1.1 101");
  }
  /// The answer to Upgrade.
  const std::string& head() const { return head_; }
  /// One masked frame of up to 65535 bytes; `opcode` 1 is text, 0x80 the end of a message.
  static std::string Frame(const std::string& payload, int first = 0x81) {
    std::string frame(1, static_cast<char>(first));
    if (payload.size() < 126) {
      frame += static_cast<char>(0x80 | payload.size());
    } else {
      frame += static_cast<char>(0x80 | 126);
      frame += static_cast<char>(payload.size() >> 8);
      frame += static_cast<char>(payload.size() & 0xff);
    }
    frame += std::string(4, '\0');  // a mask of zeros
    return frame + payload;
  }

 private:
  void Take(int wait_ms) {
    turn_();
    pollfd poller{fd_, POLLIN, 0};
    if (fd_ < 0 || poll(&poller, 1, wait_ms) <= 0) return;
    char buffer[65536];
    const ssize_t n = recv(fd_, buffer, sizeof buffer, MSG_DONTWAIT);
    if (n > 0) heard_.append(buffer, static_cast<std::size_t>(n));
    if (n == 0 || (n < 0 && errno != EAGAIN)) ended_ = true;
  }

  std::function<void()> turn_;
  int fd_;
  bool connected_ = false, ended_ = false;
  std::string heard_, head_;
};

}  // namespace priamos
