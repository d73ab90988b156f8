#include "common/serial_port.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace priamos {
namespace {

constexpr std::array<std::pair<int, speed_t>, 10> kSpeeds{{{1200, B1200},
                                                           {2400, B2400},
                                                           {4800, B4800},
                                                           {9600, B9600},
                                                           {19200, B19200},
                                                           {38400, B38400},
                                                           {57600, B57600},
                                                           {115200, B115200},
                                                           {230400, B230400},
                                                           {460800, B460800}}};

speed_t SpeedOf(const std::string& path, int baud) {
  for (const auto& [rate, speed] : kSpeeds)
    if (rate == baud) return speed;
  throw std::runtime_error(fmt::format("{}: {}", path, SerialRateProblem(baud)));
}

/// What a person does about `error` after open(2).
std::string NextStep(int error, const std::string& path) {
  switch (error) {
    case ENOENT:
      return "plug in the modem and see `ls /dev/serial/by-id`, or make a pair with `priamos link emulate`";
    case EACCES:
      return "`sudo usermod -aG dialout $USER` and log in again";
    case EBUSY:
      return fmt::format("another process holds it: `fuser {}` names it", path);
    case ELOOP:
      return fmt::format("its symbolic links lead to each other: see `ls -l {}`", path);
    default:
      return "check the cable and the driver with `dmesg`";
  }
}

class SerialPort : public ByteStream {
 public:
  SerialPort(const std::string& path, int baud) : path_(path), speed_(SpeedOf(path, baud)) { Open(); }
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;
  ~SerialPort() override { Close(); }

  std::size_t Read(std::span<std::byte> into) override {
    if (!Usable()) return 0;
    const ssize_t n = read(fd_, into.data(), into.size());
    if (n == 0 && HungUp()) {
      Close();
      return 0;
    }
    return Done(n, "read from");
  }
  std::size_t Write(std::span<const std::byte> bytes) override {
    return Usable() ? Done(write(fd_, bytes.data(), bytes.size()), "write to") : 0;
  }

 private:
  using Clock = std::chrono::steady_clock;

  void Open() {
    // O_NONBLOCK at open: a port without carrier must not hang the process.
    fd_ = open(path_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (fd_ < 0) {
      const int error = errno;
      throw std::runtime_error(fmt::format("cannot open serial port {} ({}): {}", path_, std::strerror(error),
                                           NextStep(error, path_)));
    }
    try {
      Configure();
    } catch (...) {
      Close();
      throw;
    }
  }
  void Close() {
    if (fd_ >= 0) close(fd_);
    fd_ = -1;
    try_again_ = Clock::now() + kTryAgain;  // what has just gone may still have its name
  }
  /// A port that was pulled out is looked for again now and then.
  bool Usable() {
    if (fd_ >= 0) return true;
    if (Clock::now() < try_again_) return false;
    try_again_ = Clock::now() + kTryAgain;
    try {
      Open();
    } catch (const std::runtime_error&) {
      return false;
    }
    return true;
  }
  bool HungUp() const {
    pollfd fd{fd_, POLLIN, 0};
    return poll(&fd, 1, 0) == 1 && (fd.revents & (POLLHUP | POLLERR)) != 0;
  }
  void Configure() {
    if (!isatty(fd_))
      throw std::runtime_error(fmt::format(
          "{} is not a tty: give --port the serial port of the modem, see `ls /dev/serial/by-id`", path_));
    // TIOCEXCL keeps out everybody, but stays while anybody has the tty open, as an emulated line has: it
    // takes it off again. The file lock keeps out our own programs, and ends with its holder.
    if (flock(fd_, LOCK_EX | LOCK_NB) != 0)
      throw std::runtime_error(fmt::format("cannot open serial port {} ({}): {}", path_, std::strerror(EBUSY),
                                           NextStep(EBUSY, path_)));
    if (ioctl(fd_, TIOCEXCL) != 0) Fail("lock");
    termios settings{};
    if (tcgetattr(fd_, &settings) != 0) Fail("read the settings of");
    cfmakeraw(&settings);
    settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS | PARENB | HUPCL);
    settings.c_cflag |= CLOCAL | CREAD | CS8;
    settings.c_cc[VMIN] = 0;
    settings.c_cc[VTIME] = 0;
    cfsetispeed(&settings, speed_);
    cfsetospeed(&settings, speed_);
    if (tcsetattr(fd_, TCSANOW, &settings) != 0) Fail("set");
    tcflush(fd_, TCIOFLUSH);
  }
  std::size_t Done(ssize_t n, const char* what) {
    if (n >= 0) return static_cast<std::size_t>(n);
    if (errno == EAGAIN || errno == EINTR) return 0;
    // Pulled out, or a pty whose other side is gone: this one never comes back, another one under its name
    // may.
    if (errno == EIO || errno == ENXIO || errno == ENODEV) {
      Close();
      return 0;
    }
    Fail(what);
  }
  [[noreturn]] void Fail(const char* what) const {
    throw std::runtime_error(fmt::format("cannot {} serial port {}: {}", what, path_, std::strerror(errno)));
  }

  static constexpr std::chrono::milliseconds kTryAgain{200};

  std::string path_;
  speed_t speed_;
  int fd_ = -1;
  Clock::time_point try_again_{};
};

}  // namespace

std::unique_ptr<ByteStream> OpenSerialPort(const std::string& path, int baud) {
  return std::make_unique<SerialPort>(path, baud);
}

std::string SerialRateProblem(int baud) {
  std::string rates;
  for (const auto& [rate, speed] : kSpeeds) {
    if (rate == baud) return {};
    rates += fmt::format("{}{}", rates.empty() ? "" : ", ", rate);
  }
  return fmt::format("no serial port runs at {} baud, use one of {}", baud, rates);
}

}  // namespace priamos
