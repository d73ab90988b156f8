#include "cli/terminal/plain_numbers.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>

namespace priamos::cli {
namespace {

/// Rounding error of a product or a sum, relative to its value.
constexpr double kRoundingError = 4 * std::numeric_limits<double>::epsilon();

double Plain(double value) {
  const double decimal = std::strtod(fmt::format("{:.12g}", value).c_str(), nullptr);
  return std::abs(decimal - value) <= kRoundingError * std::abs(value) ? decimal : value;
}

}  // namespace

bus::Json WithPlainNumbers(bus::Json json) {
  if (json.is_number_float()) return Plain(json.get<double>());
  if (json.is_structured())
    for (auto& item : json) item = WithPlainNumbers(std::move(item));
  return json;
}

}  // namespace priamos::cli
