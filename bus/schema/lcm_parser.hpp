#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bus/schema/model.hpp"

namespace priamos::bus {

/// Reads one .lcm file: any number of packages and structs, in LCM 1.5's grammar. Nested types are names
/// still (Schema resolves them) and fingerprints are 0.
///
/// A comment belongs to the field that it leads (own lines directly above) or follows (same line, or lines
/// below in the same column); the annotation is read from the part that begins with a bracket.
///
/// Throws SchemaError, `file:line: sentence`, for a text lcm-gen would refuse, and for enums, which lcm-gen
/// gives to no language but C and Java. `file` is only used in messages.
std::vector<Struct> ParseLcm(std::string_view file, std::string_view text);

/// A type that cannot be read: its full name, empty when not even that is known, and `file:line: sentence`.
struct TypeProblem {
  std::string type;
  std::string sentence;
};

/// As above, but a type that cannot be read adds to `problems`, and the others of the file are returned.
std::vector<Struct> ParseLcm(std::string_view file, std::string_view text,
                             std::vector<TypeProblem>& problems);

}  // namespace priamos::bus
