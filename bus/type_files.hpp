#pragma once

#include <filesystem>
#include <vector>

#include "bus/schema/schema.hpp"

namespace priamos::bus {

/// All *.lcm below `folder`, as sources of a Schema, in the order of their paths. Throws SchemaError when the
/// folder cannot be read or holds none.
std::vector<Schema::Source> ReadTypeFiles(const std::filesystem::path& folder);

}  // namespace priamos::bus
