#pragma once

#include <string>
#include <string_view>

#include "bus/log/log_player.hpp"

namespace priamos::cli {

inline constexpr std::string_view kPlayKeysHelp =
    "Keys: space pause, s one event, left/right 1 s, down/up 10 s, - and + speed, 1 original speed, m max, "
    "0 beginning, q quit";

/// Short help on the keys, shown beside the position.
inline constexpr std::string_view kPlayKeysInShort =
    "space pause, s step, \u2190\u2192 1 s, \u2191\u2193 10 s, -+ speed, 1 original, m max, 0 begin, q quit";

/// Carries out the keys; false for quit. Arrow keys come as escape sequences.
bool ApplyKeys(std::string_view keys, bus::LogPlayer& player, Time now);

/// "1/4", "2", "max".
std::string SpeedText(double speed);

}  // namespace priamos::cli
