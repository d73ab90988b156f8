#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bus/schema/schema.hpp"

namespace priamos::bus {

/// All *.lcm below `folder`, as sources of a Schema, in the order of their paths. Throws SchemaError when the
/// folder cannot be read or holds none.
std::vector<Schema::Source> ReadTypeFiles(const std::filesystem::path& folder);

/// All *.lcm below several folders, each file once. A file that cannot be read adds a sentence to `problems`.
/// Throws SchemaError when one of the folders cannot be read or holds none.
std::vector<Schema::Source> ReadTypeFolders(const std::vector<std::string>& folders,
                                            std::vector<std::string>& problems);

}  // namespace priamos::bus
