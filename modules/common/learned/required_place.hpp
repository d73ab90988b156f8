#pragma once

#include <string_view>

#include "common/archive.hpp"

namespace priamos {

/// Refuses an entry of a learned map that does not say which one it is, and where: no other value would do in
/// their stead.
inline void RequirePlace(Archive& a, std::string_view number) {
  a.Require("id", number);
  a.Require("x_m", "a place, x_m and y_m");
  a.Require("y_m", "a place, x_m and y_m");
}

}  // namespace priamos
