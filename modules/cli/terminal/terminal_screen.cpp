#include "cli/terminal/terminal_screen.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <iostream>
#include <limits>
#include <sstream>

namespace priamos::cli {
namespace {

/// The other screen, no cursor, lines cut at the right border; and back. (ECMA-48, xterm.)
constexpr const char* kEnter = "\x1b[?1049h\x1b[?25l\x1b[?7l";
constexpr const char* kLeave = "\x1b[?7h\x1b[?25h\x1b[?1049l";
constexpr const char *kHome = "\x1b[H", *kEraseLine = "\x1b[K", *kEraseBelow = "\x1b[J";

}  // namespace

std::optional<ScreenSize> TerminalSize(int fd) {
  winsize size{};
  if (ioctl(fd, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) return std::nullopt;
  return ScreenSize{size.ws_col, size.ws_row};
}

std::optional<ScreenSize> TableSize() {
  auto size = TerminalSize(STDOUT_FILENO);
  if (size) size->rows = std::numeric_limits<int>::max();
  return size;
}

TerminalScreen::TerminalScreen() : is_terminal_(isatty(STDOUT_FILENO) == 1) {}

TerminalScreen::~TerminalScreen() {
  if (entered_) std::cout << kLeave << std::flush;
}

std::optional<ScreenSize> TerminalScreen::size() const {
  if (!is_terminal_) return std::nullopt;
  return TerminalSize(STDOUT_FILENO).value_or(ScreenSize{});
}

bool TerminalScreen::Due(Time now, Duration period) {
  const auto size = this->size();
  const bool resized =
      size && (!shown_size_ || size->columns != shown_size_->columns || size->rows != shown_size_->rows);
  if (next_ && now < *next_ && !resized) return false;
  next_ = now + period;
  shown_size_ = size;
  return true;
}

void TerminalScreen::Show(const std::string& text) {
  const auto size = this->size();
  if (!size) {
    std::cout << text << "\n" << std::flush;
    return;
  }
  // Line by line, not the whole screen first: nothing flickers. A line is erased before it is written,
  // because its last column would be lost otherwise. The last line has no line feed: nothing scrolls.
  std::istringstream lines(text);
  std::string screen = entered_ ? kHome : std::string(kEnter) + kHome, line;
  entered_ = true;
  int row = 0;
  for (; row < size->rows && std::getline(lines, line); ++row)
    screen += std::string(row == 0 ? "" : "\r\n") + kEraseLine + line;
  if (row < size->rows) screen += std::string("\r\n") + kEraseBelow;
  std::cout << screen << std::flush;
}

}  // namespace priamos::cli
