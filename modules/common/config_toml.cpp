#include "common/config_toml.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "common/archive.hpp"
#include "common/nearest_file.hpp"

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

toml::table ParseFile(const std::string& path) {
  if (!std::filesystem::is_regular_file(path))
    throw ConfigError(
        fmt::format("{}: expected a configuration file, got none{}", path, NearestFileText(path, ".toml")));
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

toml::table ParseToml(const std::string& path, const std::vector<std::string>& overrides) {
  toml::table table = path.empty() ? toml::table{} : ParseFile(path);
  for (const auto& text : overrides) Merge(table, ParseOverride(text));
  return table;
}

}  // namespace priamos
