#include "common/config_toml.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/archive.hpp"
#include "common/input/quoted.hpp"
#include "common/input/regular_file.hpp"
#include "common/text/nearest_file.hpp"

namespace priamos {

namespace {

/// Parts of a dotted key; each is a table within the last, and what walks through them does so by recursion.
constexpr std::ptrdiff_t kMostParts = 32;
constexpr std::size_t kMostBytes = 1 << 20;

void RefuseDeepKeys(const std::string& name, std::string_view text) {
  int line = 1;
  for (std::size_t at = 0; at < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view row = text.substr(at, end - at);
    const std::size_t first = row.find_first_not_of(" \t");
    const bool header = first != row.npos && row[first] == '[' && row.find(',') == row.npos;
    const std::string_view key = header ? row.substr(0, row.find('#')) : row.substr(0, row.find('='));
    const bool has_key = header || row.find('=') != row.npos;
    if (const auto parts = 1 + std::count(key.begin(), key.end(), '.'); has_key && parts > kMostParts)
      throw ConfigError(
          fmt::format("{}:{}: expected a key of at most {} parts, got {}", name, line, kMostParts, parts));
    at = end + 1;
  }
}

}  // namespace

toml::table ParseToml(const std::string& name, std::string_view text) {
  RefuseDeepKeys(name, text);
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw ConfigError(fmt::format("{}:{}: expected TOML, got: {}", Escaped(name), error.source().begin.line,
                                  Escaped(Shortened(error.description()))));
  }
}

namespace {

toml::table ParseFile(const std::string& path) {
  const RegularFile file(path);
  if (!file.open())
    throw ConfigError(fmt::format("{}: expected a configuration file, got {}{}", Escaped(path),
                                  file.problem(), file.missing() ? NearestFileText(path, ".toml") : ""));
  const auto text = file.Read(kMostBytes);
  if (!text)
    throw ConfigError(fmt::format("{}: expected a file of at most {} bytes that can be read, got another",
                                  Escaped(path), kMostBytes));
  return ParseToml(path, std::string_view(*text));
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
  RefuseDeepKeys(name, text);
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
