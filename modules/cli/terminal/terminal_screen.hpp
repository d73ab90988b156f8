#pragma once

#include <optional>
#include <string>

#include "cli/terminal/text_table.hpp"
#include "common/time.hpp"

namespace priamos::cli {

/// Size of the terminal that `fd` is; none when it is no terminal, or does not know.
std::optional<ScreenSize> TerminalSize(int fd);
/// What a table that is printed once has to fit into: the width of the terminal on standard output, any
/// number of rows. None when standard output is no terminal.
std::optional<ScreenSize> TableSize();

/// A live screen on standard output. On a terminal it takes the other screen and hides the cursor from the
/// first text on, and leaves what was there before as it was when it ends; into a file or a pipe it writes
/// one text after the other. Whoever uses it watches signals before the first text (bus::SignalWatch), so
/// that it also ends at Ctrl-C.
class TerminalScreen {
 public:
  TerminalScreen();
  ~TerminalScreen();
  TerminalScreen(const TerminalScreen&) = delete;
  TerminalScreen& operator=(const TerminalScreen&) = delete;

  /// What a text has to fit into now; nothing limits it when this is no terminal.
  std::optional<ScreenSize> size() const;
  bool is_terminal() const { return is_terminal_; }
  /// True when `period` is over since it was true last, or when the terminal's size has changed.
  bool Due(Time now, Duration period);
  /// Shows `text` instead of what was shown before.
  void Show(const std::string& text);

 private:
  bool is_terminal_, entered_ = false;
  std::optional<ScreenSize> shown_size_;
  std::optional<Time> next_;
};

}  // namespace priamos::cli
