#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/archive.hpp"

namespace priamos {

/// Where a configuration comes from: a TOML file (none: the struct's defaults), then single keys on top.
struct ConfigSource {
  std::string path;
  /// Values that replace those of the file: `key = value` as TOML, dotted keys for sections; a bare word is a
  /// string.
  std::vector<std::string> overrides;
  /// File of parameters that the process saved while it ran (parameters/); empty: none. LoadConfig leaves it
  /// aside.
  std::string saved{};

  /// Where relative file names in the configuration start; the working directory when there is no file.
  std::string Folder() const;
};

/// A TOML file being read into a struct.
class ConfigFile {
 public:
  /// Reads the file of `source`. Throws ConfigError when it is missing, not readable or not TOML.
  explicit ConfigFile(const ConfigSource& source);
  /// Reads a TOML text; `name` stands for the file in messages.
  ConfigFile(const std::string& name, std::string_view text);
  ~ConfigFile();

  Archive& archive();
  /// Checks that every key of the file was asked for. Throws ConfigError for the first that was not.
  void RefuseUnknownKeys() const;

 private:
  class Reader;
  std::unique_ptr<Reader> reader_;
};

/// Reads `source` into a T. Throws ConfigError.
template <class T>
T LoadConfig(const ConfigSource& source) {
  T config;
  ConfigFile file(source);
  config.Describe(file.archive());
  file.RefuseUnknownKeys();
  return config;
}

template <class T>
T LoadConfig(const std::string& path) {
  return LoadConfig<T>(ConfigSource{path, {}});
}

/// Reads a TOML text into a T; `name` stands for the file in messages. Throws ConfigError.
template <class T>
T ParseConfig(const std::string& name, std::string_view text) {
  T config;
  ConfigFile file(name, text);
  config.Describe(file.archive());
  file.RefuseUnknownKeys();
  return config;
}

}  // namespace priamos
