#include "cli/terminal/json_line.hpp"

#include <nlohmann/json.hpp>

namespace priamos::cli {

std::string JsonLine(const std::vector<std::pair<std::string, JsonScalar>>& members) {
  auto json = nlohmann::ordered_json::object();
  for (const auto& [key, value] : members)
    std::visit([&json, &key = key](const auto& v) { json[key] = v; }, value);
  return json.dump();
}

}  // namespace priamos::cli
