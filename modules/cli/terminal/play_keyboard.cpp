#include "cli/terminal/play_keyboard.hpp"

#include <unistd.h>

#include <iostream>

#include "cli/terminal/terminal_screen.hpp"

namespace priamos::cli {
namespace {

constexpr const char* kWipe = "\r\x1b[K";
constexpr const char* kUpAndWipe = "\x1b[A\x1b[K";
constexpr tcflag_t kLineMode = ICANON | ECHO;

}  // namespace

PlayKeyboard::PlayKeyboard() : is_terminal_(isatty(STDIN_FILENO) == 1) {
  Keep();
}

PlayKeyboard::~PlayKeyboard() {
  // A background process that touches the terminal is stopped by the kernel.
  if (taken_ && IsForeground()) tcsetattr(STDIN_FILENO, TCSANOW, &before_);
}

bool PlayKeyboard::IsForeground() const {
  return is_terminal_ && tcgetpgrp(STDIN_FILENO) == getpgrp();
}

void PlayKeyboard::Keep() {
  termios now;
  if (!IsForeground() || tcgetattr(STDIN_FILENO, &now) != 0) {
    taken_ = false;
    return;
  }
  if (taken_ && (now.c_lflag & kLineMode) == 0) return;
  before_ = now;
  now.c_lflag &= ~kLineMode;
  taken_ = tcsetattr(STDIN_FILENO, TCSANOW, &now) == 0;
}

std::string PlayKeyboard::Read() const {
  char keys[16];
  const ssize_t n = taken_ ? read(STDIN_FILENO, keys, sizeof keys) : 0;
  return n > 0 ? std::string(keys, static_cast<std::size_t>(n)) : "";
}

StatusLine::StatusLine() : is_terminal_(isatty(STDERR_FILENO) == 1) {}

StatusLine::~StatusLine() {
  Wipe();
}

void StatusLine::Show(const std::string& text) {
  if (!is_terminal_ || tcgetpgrp(STDERR_FILENO) != getpgrp()) return;
  // The last column stays free: some terminals go to the next line there.
  const int columns = TerminalSize(STDERR_FILENO).value_or(ScreenSize{}).columns - 1;
  std::string rows = Wrapped(text, columns);
  rows.pop_back();  // the cursor stays in the last row
  Wipe();
  std::cerr << (rows_ == 0 ? kWipe : "") << rows << std::flush;
  rows_ = Lines(rows) + 1;
}

void StatusLine::Wipe() {
  if (rows_ == 0) return;
  std::string wipe = kWipe;
  for (int row = 1; row < rows_; ++row) wipe += kUpAndWipe;
  std::cerr << wipe << std::flush;
  rows_ = 0;
}

}  // namespace priamos::cli
