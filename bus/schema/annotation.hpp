#pragma once

#include <string_view>

#include "bus/schema/model.hpp"

namespace priamos::bus {

/// Reads a decimal number ("-1", "0.005", "1e-3"), nothing before or behind it.
std::optional<Number> ParseNumber(std::string_view text);

/// Reads the comment of a field,
///
///     [unit] @frame F @range A,B @step S @invalid V @max N[,N..] @age US @refuse: meaning
///
/// every tag optional, in any order, each once. A comment that does not begin with a bracket is somebody
/// else's comment: all of it becomes the meaning. One that begins with a bracket but cannot be read sets
/// `problem` and is no error here: such a type can be shown and checked, only not packed.
Annotation ParseAnnotation(std::string_view comment);

}  // namespace priamos::bus
