#pragma once

#include "bus/schema/schema.hpp"

namespace priamos::bus {

/// The schema of lcmtypes/, from the texts compiled in.
Schema OwnTypes();

}  // namespace priamos::bus
