#include "bus/schema/json_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

namespace priamos::bus {
namespace {

/// Digits d1 d2 ... of a number of the value 0.d1d2... times 10 to the power of `point`.
std::string Placed(const std::string& digits, int point) {
  const auto size = static_cast<int>(digits.size());
  if (point <= -4 || point > 16)
    return fmt::format("{}{}{}e{:+03}", digits[0], size > 1 ? "." : "", digits.substr(1), point - 1);
  if (point <= 0) return fmt::format("0.{:0<{}}{}", "", -point, digits);
  if (point >= size) return fmt::format("{:0<{}}.0", digits, point);
  return fmt::format("{}.{}", digits.substr(0, static_cast<std::size_t>(point)),
                     digits.substr(static_cast<std::size_t>(point)));
}

std::string NumberText(double value) {
  if (!std::isfinite(value)) return "null";
  constexpr std::size_t kLongest = 32;
  char text[kLongest];
  const auto end = std::to_chars(text, text + kLongest, std::abs(value), std::chars_format::scientific).ptr;
  const std::string_view written(text, static_cast<std::size_t>(end - text));  // "1.25e+03"
  const std::size_t e = written.find('e');
  int exponent = 0;
  std::from_chars(written.data() + e + (written[e + 1] == '+' ? 2 : 1), end, exponent);
  std::string digits(written.substr(0, e));
  std::erase(digits, '.');
  return fmt::format("{}{}", std::signbit(value) ? "-" : "", Placed(digits, exponent + 1));
}

std::string QuotedText(const std::string& text) {
  return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

void Write(const Json& json, std::string& out) {
  const char* comma = "";
  switch (json.type()) {
    case Json::value_t::object:
      out += '{';
      for (const auto& [key, value] : json.items()) {
        out += std::exchange(comma, ",");
        out += QuotedText(key);
        out += ':';
        Write(value, out);
      }
      out += '}';
      return;
    case Json::value_t::array:
      out += '[';
      for (const Json& value : json) {
        out += std::exchange(comma, ",");
        Write(value, out);
      }
      out += ']';
      return;
    case Json::value_t::number_float:
      out += NumberText(json.get<double>());
      return;
    case Json::value_t::string:
      out += QuotedText(json.get_ref<const std::string&>());
      return;
    default:
      out += json.dump();
  }
}

}  // namespace

std::string JsonText(const Json& json) {
  std::string text;
  Write(json, text);
  return text;
}

}  // namespace priamos::bus
