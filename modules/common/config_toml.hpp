#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>

#include "common/config.hpp"

namespace priamos {

/// Stands for the file in what `--set` gave; no file is called so.
inline constexpr std::string_view kSetName = "--set ";

/// The table that `text` is; `name` stands for its file in messages. Throws ConfigError when it is no TOML.
toml::table ParseToml(const std::string& name, std::string_view text);

/// The table of the file, if there is one, with the overrides on top. Throws ConfigError for a file that is
/// not there or no TOML, and for an override that is not KEY=VALUE.
toml::table ParseToml(const ConfigSource& source);

}  // namespace priamos
