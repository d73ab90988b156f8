#pragma once

#include <string>
#include <string_view>

#include "common/input/utf8.hpp"

namespace priamos::bus {

/// As much of a text as HEALTH carries: @max of health_t.text, and no half character at its end.
inline std::string FitHealthText(std::string_view text) {
  constexpr std::size_t kMostBytes = 94;
  return std::string(CutUtf8(text, kMostBytes));
}

}  // namespace priamos::bus
