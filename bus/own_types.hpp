#pragma once

#include <vector>

#include "bus/schema/schema.hpp"
#include "lcmtypes/embedded_types.hpp"

namespace priamos::bus {

/// The schema of lcmtypes/, from the texts compiled in, and of `further` texts. Throws SchemaError.
Schema OwnTypes(const std::vector<TypeText>& further = {});

}  // namespace priamos::bus
