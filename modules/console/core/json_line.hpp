#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace priamos::console {

/// JSON on one line. Bytes that are no UTF-8, as a foreign process may send them, become U+FFFD.
inline std::string JsonLine(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace priamos::console
