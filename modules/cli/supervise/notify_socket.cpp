#include "cli/supervise/notify_socket.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <system_error>

namespace priamos::cli {
namespace {

std::string StatusIn(std::string_view text) {
  constexpr std::string_view kKey = "STATUS=";
  const auto at = text.starts_with(kKey) ? 0 : text.find("\nSTATUS=");
  if (at == std::string_view::npos) return "";
  text.remove_prefix(at + kKey.size() + (at == 0 ? 0 : 1));
  return std::string(text.substr(0, text.find('\n')));
}

bool HasLine(std::string_view text, std::string_view line) {
  while (!text.empty()) {
    const auto end = text.find('\n');
    if (text.substr(0, end) == line) return true;
    text = end == std::string_view::npos ? "" : text.substr(end + 1);
  }
  return false;
}

pid_t SenderOf(msghdr& header) {
  for (cmsghdr* c = CMSG_FIRSTHDR(&header); c; c = CMSG_NXTHDR(&header, c)) {
    if (c->cmsg_level != SOL_SOCKET || c->cmsg_type != SCM_CREDENTIALS) continue;
    ucred who{};
    std::memcpy(&who, CMSG_DATA(c), sizeof who);
    return who.pid;
  }
  return 0;
}

}  // namespace

NotifySocket::NotifySocket() {
  fd_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const int on = 1;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  // An address without a name: the kernel chooses a free one in the abstract namespace.
  if (fd_ < 0 || setsockopt(fd_, SOL_SOCKET, SO_PASSCRED, &on, sizeof on) != 0 ||
      bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address.sun_family) != 0)
    throw std::system_error(errno, std::generic_category(), "notify socket");
  socklen_t length = sizeof address;
  getsockname(fd_, reinterpret_cast<sockaddr*>(&address), &length);
  // The kernel's name begins with a zero, for which sd_notify writes @.
  name_.assign(address.sun_path, length - sizeof address.sun_family);
  name_[0] = '@';
}

NotifySocket::~NotifySocket() {
  if (fd_ >= 0) close(fd_);
}

std::vector<NotifySocket::Message> NotifySocket::Read() {
  std::vector<Message> messages;
  for (;;) {
    std::array<char, 512> text;
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(ucred))> control;
    iovec part{text.data(), text.size()};
    msghdr header{};
    header.msg_iov = &part;
    header.msg_iovlen = 1;
    header.msg_control = control.data();
    header.msg_controllen = control.size();
    const ssize_t n = recvmsg(fd_, &header, MSG_CMSG_CLOEXEC);
    if (n < 0) return messages;
    const std::string_view lines(text.data(), static_cast<std::size_t>(n));
    messages.push_back(
        {SenderOf(header), HasLine(lines, "READY=1"), HasLine(lines, "WATCHDOG=1"), StatusIn(lines)});
  }
}

}  // namespace priamos::cli
