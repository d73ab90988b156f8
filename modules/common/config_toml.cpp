#include "common/config_toml.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <vector>

#include "common/nearest_word.hpp"

namespace priamos {

toml::table ParseToml(const std::string& name, std::string_view text) {
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw ConfigError(fmt::format("{}:{}: expected TOML, got: {}", name, error.source().begin.line,
                                  std::string(error.description())));
  }
}

namespace {

std::string NearestFiles(const std::filesystem::path& wanted) {
  std::vector<std::string> names;
  std::error_code none;
  const auto folder = wanted.has_parent_path() ? wanted.parent_path() : ".";
  for (const auto& entry : std::filesystem::directory_iterator(folder, none))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().filename());
  return NearestText(wanted.filename().string(), names);
}

toml::table ParseFile(const std::string& path) {
  if (!std::filesystem::is_regular_file(path))
    throw ConfigError(fmt::format("{}: expected a configuration file, got none{}", path, NearestFiles(path)));
  try {
    return toml::parse_file(path);
  } catch (const toml::parse_error& error) {
    throw ConfigError(fmt::format("{}:{}: expected TOML, got: {}", path, error.source().begin.line,
                                  std::string(error.description())));
  }
}

void Merge(toml::table& into, toml::table&& from) {
  for (auto&& [key, node] : from) {
    auto* inner = into[key].as_table();
    if (inner && node.is_table()) {
      Merge(*inner, std::move(*node.as_table()));
    } else {
      into.insert_or_assign(key, std::move(node));
    }
  }
}

toml::table ParseOverride(const std::string& text) {
  const std::string name = std::string(kSetName) + text;
  try {
    toml::table table = toml::parse(text, std::string_view(name));
    if (table.empty()) throw ConfigError(fmt::format("{}\"{}\": expected KEY=VALUE", kSetName, text));
    return table;
  } catch (const toml::parse_error&) {
    // `port=/dev/ttyS0` is what people type; TOML wants the quotes.
    const auto equals = text.find('=');
    if (equals == std::string::npos) throw ConfigError(fmt::format("{}: expected KEY=VALUE", name));
    return ParseToml(name, fmt::format("{} = '{}'", text.substr(0, equals), text.substr(equals + 1)));
  }
}

}  // namespace

toml::table ParseToml(const ConfigSource& source) {
  toml::table table = source.path.empty() ? toml::table{} : ParseFile(source.path);
  for (const auto& text : source.overrides) Merge(table, ParseOverride(text));
  return table;
}

}  // namespace priamos
