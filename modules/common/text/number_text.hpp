#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace priamos {

/// The number of type `T` that is the whole of `text`: nullopt for an empty text, anything before or behind
/// the number (also a plus sign or a blank), and a number that T cannot hold. Infinity and NaN are numbers of
/// a floating-point T. `how`: the base of a whole number, or the format of another one.
template <class T, class... How>
std::optional<T> NumberOf(std::string_view text, How... how) {
  T number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, how...);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// A number without the plus sign that some people and programs write before it.
inline std::string_view WithoutPlus(std::string_view text) {
  return text.substr(text.starts_with('+') ? 1 : 0);
}

}  // namespace priamos
