#include "common/serial_port.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

#include "test/support/temporary_folder.hpp"

namespace priamos {
namespace {

using testing::HasSubstr;

std::string ErrorOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

/// The master side of a pseudo terminal: what a modem is to the port.
class Pty {
 public:
  Pty() : fd_(posix_openpt(O_RDWR | O_NOCTTY)) {
    grantpt(fd_);
    unlockpt(fd_);
    std::array<char, 64> name{};
    ptsname_r(fd_, name.data(), name.size());
    path_ = name.data();
  }
  Pty(const Pty&) = delete;
  Pty& operator=(const Pty&) = delete;
  ~Pty() { close(fd_); }
  const std::string& path() const { return path_; }
  int fd() const { return fd_; }

 private:
  int fd_;
  std::string path_;
};

TEST(SerialPort, BytesPassUnchangedBothWays) {
  const Pty modem;
  const auto dut = OpenSerialPort(modem.path(), 9600);
  // What a cooked tty would change or eat: end of line, flow control, interrupt, end of file, parity mark.
  const std::array<std::byte, 7> sent{std::byte{0x0D}, std::byte{0x0A}, std::byte{0x11}, std::byte{0x13},
                                      std::byte{0x03}, std::byte{0x04}, std::byte{0xFF}};
  ASSERT_EQ(dut->Write(sent), sent.size());
  std::array<std::byte, 7> got{};
  ASSERT_EQ(read(modem.fd(), got.data(), got.size()), 7);
  EXPECT_EQ(got, sent);

  ASSERT_EQ(write(modem.fd(), sent.data(), sent.size()), 7);
  got = {};
  ASSERT_EQ(dut->Read(got), sent.size());
  EXPECT_EQ(got, sent);
}

TEST(SerialPort, ReadingAnEmptyPortReturnsAtOnce) {
  const Pty modem;
  std::array<std::byte, 8> got{};
  EXPECT_EQ(OpenSerialPort(modem.path(), 9600)->Read(got), 0U);
}

TEST(SerialPort, APortThatIsPulledOutIsSilentUntilThereIsOneUnderItsName) {
  const TemporaryFolder folder;
  const std::string name = (folder / "tty").string();
  auto modem = std::make_unique<Pty>();
  std::filesystem::create_symlink(modem->path(), name);
  const auto dut = OpenSerialPort(name, 9600);
  modem.reset();
  std::array<std::byte, 4> bytes{};
  for (int i = 0; i < 3; ++i) EXPECT_EQ(dut->Write(bytes) + dut->Read(bytes), 0u);

  modem = std::make_unique<Pty>();
  std::filesystem::remove(name);
  std::filesystem::create_symlink(modem->path(), name);
  std::size_t written = 0;
  for (int i = 0; i < 100 && written == 0; ++i) {
    usleep(10'000);
    written = dut->Write(bytes);
  }
  EXPECT_EQ(written, 4u);
}

TEST(SerialPort, APortThatIsHeldByAnotherIsRefusedUntilThatOneEnds) {
  const Pty modem;
  const int kept = open(modem.path().c_str(), O_RDWR | O_NOCTTY);  // as an emulated line keeps it
  auto holder = OpenSerialPort(modem.path(), 9600);
  ioctl(kept, TIOCNXCL);
  EXPECT_THAT(ErrorOf([&] { OpenSerialPort(modem.path(), 9600); }), HasSubstr("another process holds it"));
  holder.reset();
  ioctl(kept, TIOCNXCL);
  EXPECT_NO_THROW(OpenSerialPort(modem.path(), 9600));
  close(kept);
}

TEST(SerialPort, AbsentPortSaysWhatToDo) {
  EXPECT_THAT(ErrorOf([] { OpenSerialPort("/dev/no_such_tty", 9600); }),
              testing::AllOf(HasSubstr("/dev/no_such_tty"), HasSubstr("priamos link emulate")));
}

TEST(SerialPort, ALoopOfLinksIsNoPort) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("b", folder.path() / "a");
  std::filesystem::create_symlink("a", folder.path() / "b");
  EXPECT_THAT(ErrorOf([&] { OpenSerialPort(folder / "a", 9600); }),
              HasSubstr("its symbolic links lead to each other"));
}

TEST(SerialPort, AFileIsNoTty) {
  EXPECT_THAT(ErrorOf([] { OpenSerialPort("/dev/null", 9600); }), HasSubstr("is not a tty"));
}

TEST(SerialPort, UnknownBaudRateIsRefused) {
  const Pty modem;
  EXPECT_THAT(ErrorOf([&] { OpenSerialPort(modem.path(), 9601); }), HasSubstr("9600, 19200"));
}

}  // namespace
}  // namespace priamos
