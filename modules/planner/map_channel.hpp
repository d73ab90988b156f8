#pragma once
#include "lcmtypes/channels.hpp"
namespace priamos::channels {
inline constexpr Channel<features_t> kMapWalls{"MAP_WALLS", 0, std::chrono::milliseconds(0)};
}
