#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace priamos::cli {

/// What a verb that prints little as JSON says about one key.
using JsonScalar = std::variant<std::nullptr_t, bool, std::int64_t, double, std::string>;

/// A JSON object in one line, without the end of the line, its keys in the order given. For verbs that need
/// no more than that: whoever makes a nlohmann::json itself takes three seconds longer to compile.
std::string JsonLine(const std::vector<std::pair<std::string, JsonScalar>>& members);

}  // namespace priamos::cli
