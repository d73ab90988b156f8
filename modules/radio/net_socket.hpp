#pragma once

#include <netdb.h>
#include <unistd.h>

#include <memory>
#include <string>
#include <utility>

#include "radio/net_frame.hpp"

namespace priamos::radio {

/// A file descriptor that is closed when it is let go.
class Fd {
 public:
  explicit Fd(int fd = -1) : fd_(fd) {}
  Fd(Fd&& other) noexcept : fd_(other.fd_) { other.fd_ = -1; }
  Fd& operator=(Fd&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~Fd() {
    if (fd_ >= 0) close(fd_);
  }
  int get() const { return fd_; }
  bool open() const { return fd_ >= 0; }

 private:
  int fd_;
};

/// Frees what getaddrinfo() has found.
struct AddressInfoCloser {
  void operator()(addrinfo* info) const { freeaddrinfo(info); }
};
using AddressInfo = std::unique_ptr<addrinfo, AddressInfoCloser>;

/// Whether only this machine has the address.
bool IsLoopback(const addrinfo& info);
/// Address of the other end, or to wait at when no host is named. A name may have another address now than
/// when it was looked up before: with `loopback_only` one that others can reach is refused. Throws
/// std::runtime_error with one sentence.
AddressInfo LookUp(const NetAddress& address);
/// A socket that never blocks.
Fd Socket(const addrinfo& info);
void Bind(const Fd& fd, const addrinfo& info, const std::string& port);

std::unique_ptr<NetPort> OpenUdpPort(const NetAddress& address);
std::unique_ptr<NetPort> OpenTcpPort(const NetAddress& address);

}  // namespace priamos::radio
