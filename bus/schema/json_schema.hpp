#pragma once

#include <nlohmann/json_fwd.hpp>

#include "bus/schema/json.hpp"

namespace priamos::bus {

/// JSON Schema (draft 7) of what ToJson makes of a type, nested types written out, with meaning, unit and
/// range of every field as its description: what makes an exported log self-describing. Floating point
/// numbers are declared as numbers, though NaN and the infinities are strings. Throws SchemaError for a type
/// that contains itself, which cannot be written out.
Json JsonSchemaOf(const Struct& type);

}  // namespace priamos::bus
