#include "head/core/calibration/resection/point_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string_view>

#include "common/text/number_text.hpp"

namespace priamos::head {
namespace {

constexpr std::size_t kMostPoints = 100000;
constexpr double kLargest = 1e6;

/// Blanks between words; nothing after a `#`.
std::string Plain(std::string line) {
  line.resize(std::min(line.size(), line.find('#')));
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == ',' || c == ';' || c == '\t' || c == '\r'; }, ' ');
  return line;
}

std::string Shortened(const std::string& text) {
  return text.size() <= 60 ? text : text.substr(0, 57) + "...";
}

/// A finite number of sensible size that is the whole word.
std::optional<double> ParseNumber(std::string_view word) {
  const auto value = NumberOf<double>(WithoutPlus(word));
  return value && std::abs(*value) <= kLargest ? value : std::nullopt;
}

}  // namespace

Outcome<std::vector<PointPair>> ParsePointList(const std::string& text) {
  std::vector<PointPair> pairs;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(Plain(line));
    std::vector<double> values;
    for (std::string word; words >> word;) {
      const auto value = ParseNumber(word);
      if (!value)
        return Refusal{
            fmt::format("{}: expected five finite numbers X Y Z u v, got \"{}\"", number, Shortened(word))};
      values.push_back(*value);
    }
    if (values.empty()) continue;
    if (values.size() != 5)
      return Refusal{fmt::format("{}: expected five numbers X Y Z u v, got {}", number, values.size())};
    const PointPair pair{{values[0], values[1], values[2]}, {values[3], values[4]}};
    for (const PointPair& other : pairs)
      if ((other.point_m - pair.point_m).norm() < 1e-9)
        return Refusal{fmt::format("{}: expected every point of space once, got one again", number)};
    if (pairs.size() == kMostPoints) return Refusal{fmt::format("{}: expected fewer points", number)};
    pairs.push_back(pair);
  }
  return pairs;
}

}  // namespace priamos::head
