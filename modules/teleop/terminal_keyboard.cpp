#include <termios.h>
#include <unistd.h>

#include <array>
#include <stdexcept>

#include "teleop/core/keyboard.hpp"
#include "teleop/device.hpp"

namespace priamos::teleop {
namespace {

/// Standard input, key by key. The terminal gets its settings back at the end.
class TerminalKeyboard : public StickDevice {
 public:
  TerminalKeyboard(const KeyboardConfig& config, const ButtonUse& buttons)
      : keyboard_(buttons, FromSeconds(config.hold_s)) {
    if (tcgetattr(STDIN_FILENO, &before_) != 0)
      throw std::runtime_error("device: expected a terminal as standard input for the keyboard, got none");
    termios raw = before_;
    raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    // read() returns at once, with nothing when there is nothing; O_NONBLOCK would outlive this process.
    raw.c_cc[VMIN] = 0;
    raw.c_cc[VTIME] = 0;
    tcsetattr(STDIN_FILENO, TCSANOW, &raw);
  }
  ~TerminalKeyboard() override { tcsetattr(STDIN_FILENO, TCSANOW, &before_); }

  Stick Poll(Time now) override {
    std::array<char, 64> keys;
    const ssize_t n = read(STDIN_FILENO, keys.data(), keys.size());
    for (ssize_t i = 0; i < n; ++i) keyboard_.Type(keys[static_cast<std::size_t>(i)], now);
    return keyboard_.At(now);
  }
  std::string Describe() const override { return "keyboard"; }

 private:
  Keyboard keyboard_;
  termios before_{};
};

}  // namespace

std::unique_ptr<StickDevice> MakeKeyboard(const KeyboardConfig& config, const ButtonUse& buttons) {
  return std::make_unique<TerminalKeyboard>(config, buttons);
}

}  // namespace priamos::teleop
