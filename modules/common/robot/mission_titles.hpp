#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace priamos {

/// Orders to the planner in words, as a person reads them wherever they are shown.
inline std::string DoorTitle(std::string_view door) {
  return fmt::format("door '{}'", door);
}
inline std::string GotoTitle(double x_m, double y_m) {
  return fmt::format("goto ({:.2f}, {:.2f})", x_m, y_m);
}
/// `distance_m` 0: to its end.
inline std::string CorridorTitle(double distance_m) {
  return distance_m == 0 ? "corridor to its end" : fmt::format("corridor for {:.1f} m", distance_m);
}
inline constexpr std::string_view kExploreTitle = "explore the floor";
inline constexpr std::string_view kLocateTitle = "where am I?";

}  // namespace priamos
