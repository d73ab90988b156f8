#include "cli/terminal/terminal_screen.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <iostream>

namespace priamos::cli {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const Time kStart = FromUtime(1'000'000'000);
constexpr const char *kEnter = "\x1b[?1049h\x1b[?25l", *kLeave = "\x1b[?25h\x1b[?1049l";

/// A terminal in which a test reads what was shown.
class FakeTerminal {
 public:
  FakeTerminal(int columns, int rows) : master_(posix_openpt(O_RDWR | O_NOCTTY)) {
    grantpt(master_);
    unlockpt(master_);
    slave_ = open(ptsname(master_), O_RDWR | O_NOCTTY);
    termios plain{};
    tcgetattr(slave_, &plain);
    cfmakeraw(&plain);
    tcsetattr(slave_, TCSANOW, &plain);
    Resize(columns, rows);
  }
  ~FakeTerminal() {
    close(slave_);
    close(master_);
  }
  FakeTerminal(const FakeTerminal&) = delete;
  FakeTerminal& operator=(const FakeTerminal&) = delete;

  void Resize(int columns, int rows) const {
    winsize size{};
    size.ws_col = static_cast<unsigned short>(columns);
    size.ws_row = static_cast<unsigned short>(rows);
    ioctl(slave_, TIOCSWINSZ, &size);
  }
  /// Since the last call. A bell behind it says when all of it has come.
  std::string Shown() const {
    constexpr char kBell = '\a';
    std::string text;
    std::array<char, 4096> part;
    if (write(slave_, &kBell, 1) != 1) return "no terminal";
    while (!text.ends_with(kBell)) {
      const ssize_t n = read(master_, part.data(), part.size());
      if (n <= 0) return "no terminal";
      text.append(part.data(), static_cast<std::size_t>(n));
    }
    text.pop_back();
    return text;
  }
  int fd() const { return slave_; }

 private:
  int master_, slave_ = -1;
};

/// Standard output into `fd` while it lives.
class OutputTo {
 public:
  explicit OutputTo(int fd) : before_(dup(STDOUT_FILENO)) {
    std::cout << std::flush;
    dup2(fd, STDOUT_FILENO);
  }
  ~OutputTo() {
    std::cout << std::flush;
    dup2(before_, STDOUT_FILENO);
    close(before_);
  }
  OutputTo(const OutputTo&) = delete;
  OutputTo& operator=(const OutputTo&) = delete;

 private:
  int before_;
};

TEST(TerminalSize, IsThatOfATerminalAndNoneElsewhere) {
  const FakeTerminal terminal(100, 30);
  ASSERT_TRUE(TerminalSize(terminal.fd()));
  EXPECT_EQ(TerminalSize(terminal.fd())->columns, 100);
  EXPECT_EQ(TerminalSize(terminal.fd())->rows, 30);
  terminal.Resize(0, 0);
  EXPECT_FALSE(TerminalSize(terminal.fd())) << "it does not know";
  const int file = open("/dev/null", O_RDONLY);
  EXPECT_FALSE(TerminalSize(file));
  close(file);
}

TEST(TerminalSize, ATablePrintedOnceIsAsWideAsTheTerminalAndAsLongAsItIs) {
  const FakeTerminal terminal(60, 10);
  const OutputTo output(terminal.fd());
  ASSERT_TRUE(TableSize());
  EXPECT_EQ(TableSize()->columns, 60);
  EXPECT_GT(TableSize()->rows, 1'000'000);
}

TEST(TerminalScreen, OnATerminalItTakesTheOtherScreenAndGivesItBack) {
  const FakeTerminal terminal(40, 5);
  {
    const OutputTo output(terminal.fd());
    TerminalScreen dut;
    EXPECT_TRUE(dut.is_terminal());
    EXPECT_EQ(terminal.Shown(), "") << "nothing before the first text";
    dut.Show("one\ntwo");
    EXPECT_THAT(terminal.Shown(), StartsWith(kEnter));
    dut.Show("three");
    EXPECT_THAT(terminal.Shown(), Not(HasSubstr(kEnter))) << "once";
  }
  EXPECT_THAT(terminal.Shown(), EndsWith(kLeave));
}

TEST(TerminalScreen, WhatHasNoRoomIsLeftOutAndNothingScrolls) {
  const FakeTerminal terminal(40, 3);
  const OutputTo output(terminal.fd());
  TerminalScreen dut;
  dut.Show("one\ntwo\nthree\nfour\n");
  const std::string shown = terminal.Shown();
  EXPECT_THAT(shown, EndsWith("three")) << "no line feed behind the last row";
  EXPECT_THAT(shown, Not(HasSubstr("four")));
}

TEST(TerminalScreen, AShorterTextLeavesNothingOfTheLongerOne) {
  const FakeTerminal terminal(40, 10);
  const OutputTo output(terminal.fd());
  TerminalScreen dut;
  dut.Show("one\ntwo\nthree");
  terminal.Shown();
  dut.Show("four");
  EXPECT_EQ(terminal.Shown(), "\x1b[H\x1b[Kfour\r\n\x1b[J") << "home, the line anew, below it nothing";
}

TEST(TerminalScreen, IntoAFileTextsFollowEachOtherPlainly) {
  testing::internal::CaptureStdout();
  {
    TerminalScreen dut;
    EXPECT_FALSE(dut.is_terminal());
    EXPECT_FALSE(dut.size());
    dut.Show("one");
    dut.Show("two");
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "one\ntwo\n");
}

TEST(TerminalScreen, IsDueOncePerPeriod) {
  testing::internal::CaptureStdout();
  TerminalScreen dut;
  const Duration period = std::chrono::milliseconds(500);
  EXPECT_TRUE(dut.Due(kStart, period));
  EXPECT_FALSE(dut.Due(kStart + std::chrono::milliseconds(499), period));
  EXPECT_TRUE(dut.Due(kStart + std::chrono::milliseconds(500), period));
  testing::internal::GetCapturedStdout();
}

TEST(TerminalScreen, ANewSizeIsShownAtOnce) {
  const FakeTerminal terminal(40, 10);
  const OutputTo output(terminal.fd());
  TerminalScreen dut;
  EXPECT_TRUE(dut.Due(kStart, std::chrono::seconds(1)));
  EXPECT_FALSE(dut.Due(kStart, std::chrono::seconds(1)));
  terminal.Resize(41, 10);
  EXPECT_TRUE(dut.Due(kStart, std::chrono::seconds(1)));
}

}  // namespace
}  // namespace priamos::cli
