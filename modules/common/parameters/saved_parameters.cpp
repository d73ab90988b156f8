#include "common/parameters/saved_parameters.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "common/config_toml.hpp"
#include "common/input/quoted.hpp"
#include "common/replace_file.hpp"

namespace priamos {
namespace {

constexpr unsigned kMode = 0644;

void ReadTable(const std::string& path, const toml::table& table, const std::string& prefix,
               ParameterStore& store) {
  for (const auto& [key, node] : table) {
    const std::string name = prefix + std::string(key.str());
    if (const auto* inner = node.as_table()) {
      ReadTable(path, *inner, name + ".", store);
      continue;
    }
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    const auto place = [&] { return fmt::format("{}:{}:{}", path, node.source().begin.line, Escaped(name)); };
    if (!value) throw ConfigError(fmt::format("{}: expected a number, got something else", place()));
    const ChangeVerdict verdict = store.Set(store.table().NumberOf(name), *value);
    if (verdict != ChangeVerdict::kDone)
      throw ConfigError(
          fmt::format("{}: expected a value that may be saved, got {}: {}; next: remove the line", place(),
                      *value, Text(verdict)));
  }
}

}  // namespace

void ReadSavedParameters(const std::string& path, ParameterStore& store) {
  std::error_code unknown;
  if (path.empty() || !std::filesystem::exists(path, unknown)) return;
  ReadTable(path, ParseToml(path, std::vector<std::string>{}), "", store);
}

std::string SaveParameters(const std::string& path, const ParameterStore& store) {
  if (path.empty()) return "the process was started without --saved FILE";
  const auto changed = store.Changed();
  if (changed.empty()) {
    std::error_code error;
    std::filesystem::remove(path, error);
    return error ? fmt::format("{}: {}", path, error.message()) : "";
  }
  std::string text = "# Parameters that were saved while the process ran: `priamos param`.\n";
  for (const auto& [name, value] : changed) text += fmt::format("{} = {}\n", name, value);
  if (ReplaceFile(path, text, false, kMode)) return "";
  return fmt::format("{}: {}", path, std::strerror(errno));
}

}  // namespace priamos
