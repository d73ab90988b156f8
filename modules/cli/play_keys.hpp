#pragma once

#include <string>
#include <string_view>

#include "bus/log/log_player.hpp"

namespace priamos::cli {

inline constexpr std::string_view kPlayKeysHelp =
    "Keys: space pause, s one event, left/right 1 s, down/up 10 s, - and + speed, 1 original speed, m max, "
    "0 beginning, q quit";

/// Does what the keys say; false for quit. Arrow keys come as escape sequences.
bool ApplyKeys(std::string_view keys, bus::LogPlayer& player, Time now);

/// "1/4", "2", "max".
std::string SpeedText(double speed);

}  // namespace priamos::cli
