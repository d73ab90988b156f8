#pragma once

#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace priamos {

/// What one value of a configuration means and may be; printed by --print-config and checked on loading.
struct ValueSpec {
  std::string_view unit;  ///< "m", "rad/s", "-" ...
  double min = std::numeric_limits<double>::lowest();
  double max = std::numeric_limits<double>::max();
  std::string_view doc;  ///< one sentence
};

/// Text of what `spec` allows: `0 to 1.5`, `at least 0`, `any`.
std::string RangeText(const ValueSpec& spec);

/// How far a number may be changed while its process runs: anywhere in its range, or only to the careful side
/// of what file and command line say.
enum class LiveChange { kInRange, kOnlyLower, kOnlyHigher };

/// What it means, for people: `live`, `live, at most the file's`, `live, at least the file's`.
std::string_view LiveText(LiveChange change);

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
  /// Says that a number described before may be changed while the process runs; `key` is dotted, from the
  /// outermost struct on. The App's Reconfigure hands it to whoever uses it.
  virtual void Live(std::string_view /*key*/, LiveChange /*change*/) {}
  /// Refuses the value read last for a reason no range can express.
  virtual void Refuse(std::string_view key, std::string_view expected) = 0;
  /// Refuses the section that is read when it does not give the value itself.
  virtual void Require(std::string_view key, std::string_view expected) = 0;

 protected:
  virtual bool Enter(std::string_view key, std::string_view doc) = 0;
  virtual void Leave() = 0;
  virtual std::size_t BeginList(std::string_view key, std::size_t default_size, std::string_view doc) = 0;
  virtual void EnterItem(std::string_view key, std::size_t index) = 0;
};

}  // namespace priamos
