// A stream of frames. Who waits for connections takes anybody's, and keeps that of the other end.
#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>

#include "bus/radio/frame/cobs.hpp"
#include "radio/net_socket.hpp"
#include "radio/newcomers.hpp"

namespace priamos::radio {
namespace {

using bus::radio::FrameSplitter;
using bus::radio::Proof;

/// A connection that moves nothing for so long is dead; older bytes are worth nothing anyway.
constexpr unsigned kTcpTimeout_ms = 5000;
constexpr int kTcpSendBuffer = 4096;
constexpr Duration kReconnect{250'000};
constexpr int kBacklog = 64;
/// What is done for strangers in one go.
constexpr int kMostAccepted = 16;
constexpr std::size_t kReadAtOnce = 512, kReadsOfPeer = 16;

void TuneTcp(const Fd& fd) {
  const int on = 1;
  setsockopt(fd.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  setsockopt(fd.get(), IPPROTO_TCP, TCP_USER_TIMEOUT, &kTcpTimeout_ms, sizeof kTcpTimeout_ms);
  setsockopt(fd.get(), SOL_SOCKET, SO_SNDBUF, &kTcpSendBuffer, sizeof kTcpSendBuffer);
}

bool Pending() {
  return errno == EAGAIN || errno == EWOULDBLOCK || errno == ENOTCONN;
}

/// A connection with the frame that is coming in.
struct Connection {
  explicit Connection(Fd socket) : fd(std::move(socket)) {}
  Fd fd;
  FrameSplitter splitter{kLargestFrame};
  Time first_byte{};
  bool over = false;

  /// Reads once. Returns the number of bytes.
  std::size_t Read(int id, bool stranger, const TimeSource& time, std::vector<NetFrame>& frames) {
    std::array<std::byte, kReadAtOnce> buffer;
    const ssize_t n = recv(fd.get(), buffer.data(), buffer.size(), 0);
    over = n == 0 || (n < 0 && !Pending());
    if (n <= 0) return 0;
    const Time now = time();
    for (const std::byte byte : std::span(buffer).first(static_cast<std::size_t>(n))) {
      if (splitter.between_frames()) first_byte = now;
      if (splitter.Push(byte) != FrameSplitter::Event::kFrame) continue;
      const auto frame = splitter.frame();
      frames.push_back(
          {{frame.begin(), frame.end()}, first_byte, now, stranger, static_cast<std::uint64_t>(id)});
    }
    return static_cast<std::size_t>(n);
  }
};

class TcpPort : public NetPort {
 public:
  explicit TcpPort(const NetAddress& address) : address_(LookUp(address)) {
    if (!address.host.empty()) return;
    listener_ = Socket(*address_);
    Bind(listener_, *address_, address.port);
    if (listen(listener_.get(), kBacklog) != 0)
      throw std::runtime_error(fmt::format("port {}: {}", address.port, std::strerror(errno)));
  }

  std::vector<NetFrame> Read(const TimeSource& time) override {
    std::vector<NetFrame> frames;
    for (std::size_t i = 0; peer_ && i < kReadsOfPeer; ++i)
      if (peer_->Read(0, false, time, frames) == 0) break;
    if (peer_ && peer_->over) peer_.reset();
    if (listener_.open()) {
      ReadStrangers(time, frames);
      Accept(time());
    } else {
      Connect(time());
    }
    return frames;
  }

  void Judge(const NetFrame& frame, Proof proof) override {
    if (proof == Proof::kFresh) heard_at_ = frame.arrived;
    if (!frame.stranger) return;
    const int id = static_cast<int>(frame.place);
    if (proof == Proof::kGenuine) newcomers_.OnGenuine(id);
    if (proof != Proof::kFresh) return;
    const auto found = strangers_.find(id);
    if (found == strangers_.end()) return;
    peer_ = std::move(found->second);
    strangers_.erase(found);
    newcomers_.Remove(id);
  }

  std::size_t Write(std::span<const std::byte> bytes, Time now) override {
    if (!peer_ || !heard_at_ || now - *heard_at_ > kPlaceSilence)
      for (const int id : newcomers_.Genuine())
        if (SendTo(*strangers_.at(id), bytes) < bytes.size()) Drop(id);
    if (!peer_) return bytes.size();
    const std::size_t taken = SendTo(*peer_, bytes);
    if (peer_->over) peer_.reset();
    return taken;
  }

  std::uint64_t turned_away() const override { return turned_away_; }

 private:
  static std::size_t SendTo(Connection& connection, std::span<const std::byte> bytes) {
    const ssize_t n = send(connection.fd.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (n >= 0) return static_cast<std::size_t>(n);
    connection.over = !Pending();
    return connection.over ? bytes.size() : 0;
  }

  void Drop(int id) {
    strangers_.erase(id);
    newcomers_.Remove(id);
    ++turned_away_;
  }

  /// Those that have something to read, or an end: asked all at once.
  std::vector<int> StrangersWithBytes() const {
    std::vector<pollfd> all;
    std::vector<int> ids;
    for (const auto& [id, connection] : strangers_) {
      all.push_back({connection->fd.get(), POLLIN, 0});
      ids.push_back(id);
    }
    if (all.empty() || poll(all.data(), all.size(), 0) <= 0) return {};
    std::vector<int> ready;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].revents != 0) ready.push_back(ids[i]);
    return ready;
  }

  void ReadStrangers(const TimeSource& time, std::vector<NetFrame>& frames) {
    std::vector<int> done;
    for (const int id : StrangersWithBytes()) {
      Connection* connection = strangers_.at(id).get();
      const std::size_t n = connection->Read(id, true, time, frames);
      if (connection->over || (n > 0 && !newcomers_.OnBytes(id, n))) done.push_back(id);
    }
    for (const int id : done) Drop(id);
    for (const int id : newcomers_.Expired(time())) Drop(id);
  }

  /// Takes connections that wait. None replaces that of the other end before it has proven itself.
  void Accept(Time now) {
    for (int i = 0; i < kMostAccepted; ++i) {
      Fd next(accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
      if (!next.open()) return;
      TuneTcp(next);
      const int id = ++newest_id_;
      if (const auto leaves = newcomers_.Admit(id, now)) Drop(*leaves);
      strangers_.emplace(id, std::make_unique<Connection>(std::move(next)));
    }
  }

  /// Makes the connection to the other end, when there is none.
  void Connect(Time now) {
    if (peer_ || (tried_at_ && now - *tried_at_ < kReconnect)) return;
    tried_at_ = now;
    Fd fd = Socket(*address_);
    TuneTcp(fd);
    if (connect(fd.get(), address_->ai_addr, address_->ai_addrlen) == 0 || errno == EINPROGRESS)
      peer_ = std::make_unique<Connection>(std::move(fd));
  }

  AddressInfo address_;
  Fd listener_;
  std::unique_ptr<Connection> peer_;
  std::map<int, std::unique_ptr<Connection>> strangers_;  ///< by a number that is not used again
  Newcomers newcomers_;
  int newest_id_ = 0;
  std::optional<Time> heard_at_, tried_at_;
  std::uint64_t turned_away_ = 0;
};

}  // namespace

std::unique_ptr<NetPort> OpenTcpPort(const NetAddress& address) {
  return std::make_unique<TcpPort>(address);
}

}  // namespace priamos::radio
