#include "cli/options/path_override.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace priamos::cli {

std::string PathOverride(std::string_view key, const std::filesystem::path& path) {
  return fmt::format("{}={}", key, nlohmann::json(std::filesystem::absolute(path).string()).dump());
}

}  // namespace priamos::cli
