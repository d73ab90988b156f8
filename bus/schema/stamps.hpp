#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bus/schema/model.hpp"

namespace priamos::bus {

/// Adds `by_us` microseconds to every time stamp (field with `@age`) of an encoded message, in place, with
/// saturation. 0 stands for "no time" and stays. Returns false, and changes nothing, when Walk refuses the
/// bytes.
bool ShiftStamps(const Struct& type, std::span<std::byte> encoded, std::int64_t by_us);

}  // namespace priamos::bus
