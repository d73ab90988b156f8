#pragma once

#include <iosfwd>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "common/value_spec.hpp"

namespace priamos {

/// A configuration that cannot be used. what() is one sentence, `file:line:key: expected ..., got ...`,
/// fit to be shown to a person; processes end with exit code 2.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Visits the fields of a configuration struct, to read, check or print them. A struct takes part by
///
///     void Describe(Archive& a) {
///       a.Number("max_speed_m_s", max_speed_m_s, {"m/s", 0, 1.5, "speed limit on a path"});
///       a.Section("sonar", sonar, "the ring of 24");
///     }
///
/// A key that is absent in the file keeps the struct's default; a key that no field asked for is an error.
class Archive {
 public:
  virtual ~Archive() = default;
  virtual void Number(std::string_view key, double& value, const ValueSpec& spec) = 0;
  virtual void Integer(std::string_view key, int& value, const ValueSpec& spec) = 0;
  virtual void Flag(std::string_view key, bool& value, std::string_view doc) = 0;
  virtual void Text(std::string_view key, std::string& value, std::string_view doc) = 0;
  /// One word out of `choices`.
  virtual void Choice(std::string_view key, std::string& value, const std::vector<std::string>& choices,
                      std::string_view doc) = 0;
  /// Exactly `values.size()` numbers if that is not 0, else any number of them; each within spec.
  virtual void Numbers(std::string_view key, std::vector<double>& values, const ValueSpec& spec) = 0;

  template <class T>
  void Section(std::string_view key, T& value, std::string_view doc) {
    if (!Enter(key, doc)) return;
    value.Describe(*this);
    Leave();
  }
  /// An array of tables, `[[key]]`; given ones replace the default list.
  template <class T>
  void List(std::string_view key, std::vector<T>& values, std::string_view doc) {
    const std::size_t n = BeginList(key, values.size(), doc);
    if (n != values.size()) values.assign(n, T{});
    for (std::size_t i = 0; i < n; ++i) {
      EnterItem(key, i);
      values[i].Describe(*this);
      Leave();
    }
  }
  /// Refuses the value read last for a reason no range can express.
  virtual void Refuse(std::string_view key, std::string_view expected) = 0;

 protected:
  virtual bool Enter(std::string_view key, std::string_view doc) = 0;
  virtual void Leave() = 0;
  virtual std::size_t BeginList(std::string_view key, std::size_t default_size, std::string_view doc) = 0;
  virtual void EnterItem(std::string_view key, std::size_t index) = 0;
};

/// Where a configuration comes from: a TOML file (none: the struct's defaults), then single keys on top.
struct ConfigSource {
  std::string path;
  /// Values that replace those of the file: `key = value` as TOML, dotted keys for sections; a bare word is a
  /// string.
  std::vector<std::string> overrides;

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

/// Writes an Archive's visit as commented TOML: what --print-config shows. Loading it gives the same values.
std::unique_ptr<Archive> MakeConfigPrinter(std::ostream& out);

template <class T>
void PrintConfig(std::ostream& out, T config) {
  config.Describe(*MakeConfigPrinter(out));
}

}  // namespace priamos
