#include "common/serial_port.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
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
  throw std::runtime_error(
      fmt::format("{}: no serial port runs at {} baud, use one of 1200, 2400, 4800, 9600, 19200, 38400, "
                  "57600, 115200, 230400, 460800",
                  path, baud));
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
    default:
      return "check the cable and the driver with `dmesg`";
  }
}

class SerialPort : public ByteStream {
 public:
  SerialPort(const std::string& path, int baud) : path_(path) {
    const speed_t speed = SpeedOf(path, baud);
    // O_NONBLOCK at open: a port without carrier must not hang the process.
    fd_ = open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (fd_ < 0) {
      const int error = errno;
      throw std::runtime_error(fmt::format("cannot open serial port {} ({}): {}", path, std::strerror(error),
                                           NextStep(error, path)));
    }
    try {
      Configure(speed);
    } catch (...) {
      close(fd_);
      throw;
    }
  }
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;
  ~SerialPort() override { close(fd_); }

  std::size_t Read(std::span<std::byte> into) override {
    return Done(read(fd_, into.data(), into.size()), "read from");
  }
  std::size_t Write(std::span<const std::byte> bytes) override {
    return Done(write(fd_, bytes.data(), bytes.size()), "write to");
  }

 private:
  void Configure(speed_t speed) {
    if (!isatty(fd_))
      throw std::runtime_error(fmt::format(
          "{} is not a tty: give --port the serial port of the modem, see `ls /dev/serial/by-id`", path_));
    // TIOCEXCL keeps out everybody, but stays while anybody has the tty open, as an emulated line has: it takes
    // it off again. The file lock keeps out our own programs, and ends with its holder.
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
    cfsetispeed(&settings, speed);
    cfsetospeed(&settings, speed);
    if (tcsetattr(fd_, TCSANOW, &settings) != 0) Fail("set");
    tcflush(fd_, TCIOFLUSH);
  }
  std::size_t Done(ssize_t n, const char* what) {
    if (n >= 0) return static_cast<std::size_t>(n);
    // EIO is a port that was pulled out, or a pty whose other side is gone: neither comes back under this name.
    if (errno == EAGAIN || errno == EINTR) return 0;
    Fail(what);
  }
  [[noreturn]] void Fail(const char* what) const {
    throw std::runtime_error(fmt::format("cannot {} serial port {}: {}", what, path_, std::strerror(errno)));
  }

  std::string path_;
  int fd_ = -1;
};

}  // namespace

std::unique_ptr<ByteStream> OpenSerialPort(const std::string& path, int baud) {
  return std::make_unique<SerialPort>(path, baud);
}

}  // namespace priamos
