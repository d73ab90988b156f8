#include "cli/supervise/pseudo_terminal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace priamos::cli {
namespace {

namespace fs = std::filesystem;

void MakeRaw(int fd) {
  termios settings{};
  tcgetattr(fd, &settings);
  cfmakeraw(&settings);
  tcsetattr(fd, TCSANOW, &settings);
}

}  // namespace

PseudoTerminal::PseudoTerminal(std::string link) : link_(std::move(link)) {
  if (fs::exists(fs::symlink_status(link_)) && !fs::is_symlink(fs::symlink_status(link_)))
    throw std::runtime_error(
        fmt::format("{}: expected a free name for an emulated tty, got something else there", link_));
  master_ = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  std::array<char, 128> name{};
  if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0 ||
      ptsname_r(master_, name.data(), name.size()) != 0)
    throw std::runtime_error(fmt::format("no pseudo terminal can be had: {}", std::strerror(errno)));
  target_ = name.data();
  slave_ = open(target_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  MakeRaw(slave_);
  std::error_code error;
  fs::remove(link_, error);
  fs::create_symlink(target_, link_, error);
  if (error) {
    close(slave_);
    close(master_);
    throw std::runtime_error(fmt::format("{}: the link cannot be made: {}", link_, error.message()));
  }
}

PseudoTerminal::~PseudoTerminal() {
  std::error_code error;
  if (fs::read_symlink(link_, error) == target_) fs::remove(link_, error);
  close(slave_);
  close(master_);
}

std::vector<std::byte> PseudoTerminal::Read(std::size_t most) {
  // This process keeps the tty open: the exclusive use of a program that was killed would never end.
  ioctl(slave_, TIOCNXCL);
  std::vector<std::byte> bytes(most);
  const ssize_t n = read(master_, bytes.data(), bytes.size());
  bytes.resize(n > 0 ? static_cast<std::size_t>(n) : 0);
  return bytes;
}

void PseudoTerminal::Write(std::span<const std::byte> bytes) {
  if (!bytes.empty() && write(master_, bytes.data(), bytes.size()) < 0 && errno != EAGAIN)
    throw std::runtime_error(fmt::format("{}: cannot be written: {}", link_, std::strerror(errno)));
}

}  // namespace priamos::cli
