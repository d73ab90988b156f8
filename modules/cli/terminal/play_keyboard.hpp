#pragma once

#include <termios.h>

#include <string>

namespace priamos::cli {

/// Single keys from the terminal on standard input, without Enter and without their echo, as long as this
/// process is in its foreground; nothing when standard input is no terminal. Leaves the terminal as it found
/// it.
class PlayKeyboard {
 public:
  PlayKeyboard();
  ~PlayKeyboard();
  PlayKeyboard(const PlayKeyboard&) = delete;
  PlayKeyboard& operator=(const PlayKeyboard&) = delete;

  /// File descriptor of the terminal for poll(); -1 while there are no keys to be had.
  int fd() const { return taken_ ? 0 : -1; }
  /// Takes the terminal when this process came to its foreground: at the start, or by `fg` after Ctrl-Z.
  void Keep();
  /// Keys that were pressed.
  std::string Read() const;

 private:
  bool IsForeground() const;

  bool is_terminal_, taken_ = false;
  termios before_{};
};

/// One line at the foot of the terminal on standard error, in as many rows as it needs, that is written over
/// and over, and wiped out at the end; nothing when standard error is no terminal.
class StatusLine {
 public:
  StatusLine();
  ~StatusLine();
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  bool is_terminal() const { return is_terminal_; }
  /// Broken at blanks where the terminal is narrower than the text.
  void Show(const std::string& text);
  void Wipe();

 private:
  bool is_terminal_;
  int rows_ = 0;  ///< shown
};

}  // namespace priamos::cli
