#pragma once

#include "bus/schema/json.hpp"

namespace priamos::cli {

/// JSON value with its numbers as a person writes them: what arithmetic left a few rounding errors beside
/// a decimal of at most 12 digits becomes that decimal, as 114 steps of 0.01 m become 1.14 and not
/// 1.1400000000000001. Every other number keeps all its digits.
bus::Json WithPlainNumbers(bus::Json json);

}  // namespace priamos::cli
