#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/outcome.hpp"
#include "common/parameters/parameter_table.hpp"

namespace priamos::bus {

/// The parameters of a process with their values, as `--print-parameters` writes them for programs that were
/// not compiled with its configuration.
struct ParameterSheet {
  ParameterTable table{std::vector<Parameter>{}};
  std::vector<double> values;  ///< of the file, in the order of the table
};

/// JSON: `{"table": FINGERPRINT, "parameters": [{"name", "unit", "min", "max", "change", "value", "meaning"},
/// ...]}`; `change` is `any`, `lower` or `higher`.
std::string ToJson(const ParameterSheet& sheet);
/// Reads it; refuses what is none, also one whose fingerprint is another than that of what it holds.
Outcome<ParameterSheet> ParameterSheetOf(std::string_view json);

}  // namespace priamos::bus
