#pragma once

#include <nlohmann/json_fwd.hpp>

#include "common/time.hpp"

namespace priamos::console {

/// The moment a message speaks of: its utime or utime_exposure when that lies within the last 120 s, the
/// longest age of a message on the radio; else `arrival`.
Time ValidTime(const nlohmann::ordered_json& message, Time arrival);

}  // namespace priamos::console
