#include "cli/terminal/play_keys.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace priamos::cli {
namespace {

constexpr double kSlowest = 1.0 / 64, kFastest = 1024;

void ChangeSpeed(double factor, bus::LogPlayer& player, Time now) {
  const double before = player.speed() > 0 ? player.speed() : kFastest;
  player.SetSpeed(std::clamp(before * factor, kSlowest, kFastest), now);
}

bool ApplyArrow(char key, bus::LogPlayer& player, Time now) {
  const auto move = [&](int seconds) { player.Seek(player.position() + std::chrono::seconds(seconds), now); };
  switch (key) {
    case 'A':
      move(10);
      return true;
    case 'B':
      move(-10);
      return true;
    case 'C':
      move(1);
      return true;
    case 'D':
      move(-1);
      return true;
    default:
      return false;
  }
}

bool ApplyKey(char key, bus::LogPlayer& player, Time now) {
  switch (key) {
    case ' ':
      player.Pause(!player.paused(), now);
      return true;
    case 's':
    case '.':
      player.Step(now);
      return true;
    case '+':
      ChangeSpeed(2, player, now);
      return true;
    case '-':
      ChangeSpeed(0.5, player, now);
      return true;
    case '1':
      player.SetSpeed(1, now);
      return true;
    case 'm':
      player.SetSpeed(bus::LogPlayer::kFlatOut, now);
      return true;
    case '0':
      player.Seek({}, now);
      return true;
    default:
      return key != 'q';
  }
}

}  // namespace

bool ApplyKeys(std::string_view keys, bus::LogPlayer& player, Time now) {
  while (!keys.empty()) {
    if (keys.size() >= 3 && keys.starts_with("\x1b[") && ApplyArrow(keys[2], player, now)) {
      keys.remove_prefix(3);
    } else {
      if (!ApplyKey(keys.front(), player, now)) return false;
      keys.remove_prefix(1);
    }
  }
  return true;
}

std::string SpeedText(double speed) {
  if (speed <= 0) return "max ";
  return speed >= 1 ? fmt::format("{:g}", speed) : fmt::format("1/{:g}", 1 / speed);
}

}  // namespace priamos::cli
