#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <vector>

namespace priamos {

/// Stands for the file in what `--set` gave; no file is called so.
inline constexpr std::string_view kSetName = "--set ";

/// The table that `text` is; `name` stands for its file in messages. Throws ConfigError when it is not TOML.
toml::table ParseToml(const std::string& name, std::string_view text);

/// The table of the file `path` (empty: none) with the overrides, `KEY=VALUE`, on top. Throws ConfigError for
/// a file that is not there or not TOML, and for an override that is not KEY=VALUE.
toml::table ParseToml(const std::string& path, const std::vector<std::string>& overrides);

}  // namespace priamos
