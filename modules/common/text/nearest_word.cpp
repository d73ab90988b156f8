#include "common/text/nearest_word.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>

namespace priamos {
namespace {

/// Largest number of equally near words in an answer; more would be a list and not an answer.
constexpr std::size_t kMostAnswers = 4;
constexpr std::size_t kShortestPrefix = 2;
/// A longer text is no mistyped word, and comparing it takes its length squared.
constexpr std::size_t kLongestWord = 256;

std::string Lower(std::string_view word) {
  std::string lower(word);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower;
}

std::string WithoutUnderscores(std::string word) {
  std::erase(word, '_');
  return word;
}

/// Order of answers, the best first. 0: the same but for the case; then words that begin with it, the
/// shortest first; then by distance. nullopt: not near.
std::optional<int> Rank(const std::string& word, const std::string& known) {
  constexpr int kPrefix = 1, kResembles = 1000;
  if (word == known) return 0;
  if (WithoutUnderscores(word) == WithoutUnderscores(known)) return kPrefix;
  if (word.size() >= kShortestPrefix && known.starts_with(word))
    return kPrefix + static_cast<int>(std::min<std::size_t>(known.size() - word.size(), kResembles - 2));
  const int distance = EditDistance(word, known);
  const int allowed = std::max(1, static_cast<int>(std::max(word.size(), known.size())) / 3);
  // A word of one or two letters of which one is wrong may be anything.
  if (distance > allowed || word.size() < 3) return std::nullopt;
  return kResembles + distance;
}

}  // namespace

int EditDistance(std::string_view a, std::string_view b) {
  const std::string from = Lower(a), to = Lower(b);
  std::vector<int> before_last, last, row(to.size() + 1);
  for (std::size_t j = 0; j <= to.size(); ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= from.size(); ++i) {
    before_last = std::exchange(last, row);
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= to.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (from[i - 1] != to[j - 1])});
      const bool swapped = i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row.back();
}

std::vector<std::string> NearestWords(std::string_view word, std::span<const std::string> known) {
  if (word.size() > kLongestWord) return {};
  const std::string lower = Lower(word);
  std::vector<std::string> nearest;
  std::optional<int> best;
  for (const std::string& candidate : known) {
    const auto rank = Rank(lower, Lower(candidate));
    if (!rank || (best && *rank > *best)) continue;
    if (!best || *rank < *best) nearest.clear();
    best = rank;
    nearest.push_back(candidate);
  }
  std::sort(nearest.begin(), nearest.end());
  nearest.erase(std::unique(nearest.begin(), nearest.end()), nearest.end());
  if (nearest.size() > kMostAnswers) nearest.resize(kMostAnswers);
  return nearest;
}

std::string NearestText(std::string_view word, std::span<const std::string> known) {
  std::string text;
  for (const std::string& name : NearestWords(word, known))
    text += fmt::format("{}\"{}\"", text.empty() ? "; nearest: " : " or ", name);
  return text;
}

}  // namespace priamos
