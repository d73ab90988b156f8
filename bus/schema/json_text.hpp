#pragma once

#include <string>

#include "bus/schema/json.hpp"

namespace priamos::bus {

/// JSON as text on one line, byte for byte what bus/python writes. A number with a fraction has the fewest
/// digits that read back as it, and an exponent from 1e16 on and below 0.0001, as Python's repr() has it.
std::string JsonText(const Json& json);

}  // namespace priamos::bus
