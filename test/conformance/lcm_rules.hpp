#pragma once

#include <string>
#include <vector>

#include "bus/schema/schema.hpp"

namespace priamos::bus {

/// Largest encoding of a message: what fits into one Ethernet frame, so that LCM never fragments it.
inline constexpr std::size_t kMaxMessageBytes = 1400;

/// What is wrong with the documentation of types, one sentence `file:line: ...` each: a type without comment,
/// not bounded to kMaxMessageBytes or not packable; a field without unit, bound or meaning, with a unit that
/// its name does not tell, or a coordinate without frame.
std::vector<std::string> Violations(const Schema& schema);

}  // namespace priamos::bus
