#include "head/files/mesh_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <sstream>
#include <vector>

namespace priamos::head {
namespace {

using Words = std::vector<std::string>;

Words WordsOf(const std::string& line) {
  std::istringstream in(line);
  Words words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

template <class Value>
std::optional<Value> ValueOf(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  Value value{};
  const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || rest != word.data() + word.size()) return std::nullopt;
  return value;
}

/// Three finite numbers behind the first `from` words.
std::optional<std::string> WrongPlace(const Words& words, std::size_t from) {
  for (std::size_t i = from; i < from + 3; ++i) {
    if (i >= words.size()) return fmt::format("expected 3 numbers, got {}", words.size() - from);
    const auto number = ValueOf<double>(words[i]);
    if (!number || !std::isfinite(*number))
      return fmt::format("expected a number, got \"{}\"", words[i].substr(0, 40));
  }
  return std::nullopt;
}

/// `f 1/2/3 ...`: the number before the first stroke is that of a place, counted from 1, or back from the
/// last one when it is negative.
std::optional<std::string> WrongFace(const Words& words, int places) {
  if (words.size() < 4) return fmt::format("expected 3 corners or more, got {}", words.size() - 1);
  for (std::size_t i = 1; i < words.size(); ++i) {
    const auto corner = ValueOf<int>(std::string_view(words[i]).substr(0, words[i].find('/')));
    const bool is_there = corner && *corner != 0 && *corner >= -places && *corner <= places;
    if (!is_there)
      return fmt::format("expected the number of one of {} places, got \"{}\"", places,
                         words[i].substr(0, 40));
  }
  return std::nullopt;
}

/// Lets `check` look at the words of each line that has any.
template <class Check>
std::optional<std::string> WrongLine(std::string_view text, const Check& check) {
  std::istringstream in{std::string(text)};
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const Words words = WordsOf(line);
    if (words.empty()) continue;
    if (const auto wrong = check(words)) return fmt::format("{}: {}: {}", number, words[0], *wrong);
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> WrongLineOfObj(std::string_view text) {
  int places = 0;
  WrongLine(text, [&](const Words& words) -> std::optional<std::string> {
    places += words[0] == "v" ? 1 : 0;
    return std::nullopt;
  });
  return WrongLine(text, [&](const Words& words) -> std::optional<std::string> {
    if (words[0] == "v") return WrongPlace(words, 1);
    return words[0] == "f" ? WrongFace(words, places) : std::nullopt;
  });
}

std::optional<std::string> WrongLineOfStl(std::string_view text) {
  return WrongLine(
      text, [](const Words& words) { return words[0] == "vertex" ? WrongPlace(words, 1) : std::nullopt; });
}

}  // namespace priamos::head
