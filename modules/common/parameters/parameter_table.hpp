#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "common/archive.hpp"

namespace priamos {

/// Shows a configuration struct, which is somewhere, to an Archive.
using Description = std::function<void(Archive&)>;

/// A number of a configuration that may be changed while its process runs.
struct Parameter {
  std::string name;  ///< dotted
  std::string unit, meaning;
  double min = 0, max = 0;
  LiveChange change = LiveChange::kInRange;
};

/// The parameters of a process, as the Describe of its configuration marks them by Live. Their numbers count
/// from 1 in the order of those marks.
class ParameterTable {
 public:
  static constexpr int kMost = 127;           ///< numbers that an order has room for
  static constexpr double kFarthest = 10000;  ///< values that an order has room for, of either sign

  /// Throws std::logic_error for a mark on something that is no number, and for a range without room in an
  /// order.
  explicit ParameterTable(const Description& describe);
  /// A table that another process has made.
  explicit ParameterTable(std::vector<Parameter> parameters) : parameters_(std::move(parameters)) {}

  const std::vector<Parameter>& all() const { return parameters_; }
  /// nullptr when there is none of this number.
  const Parameter* Find(int number) const;
  /// 0 when there is none of this name.
  int NumberOf(std::string_view name) const;
  /// 1 to 65535; differs, but for one in 65535 cases, when a name, unit, range or mark differs: so numbers of
  /// one version are not taken for those of another.
  int Fingerprint() const;

 private:
  std::vector<Parameter> parameters_;
};

}  // namespace priamos
