#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace priamos {

/// Damerau-Levenshtein distance: insertions, deletions, substitutions and swaps of neighbours that turn one
/// word into the other. Upper and lower case count as equal.
int EditDistance(std::string_view a, std::string_view b);

/// The words of `known` that a mistyped `word` most probably means. Those that begin with it win over those
/// that resemble it; equally good ones are all returned, by name. Empty when nothing is near: more than a
/// third of the letters differ.
std::vector<std::string> NearestWords(std::string_view word, std::span<const std::string> known);

/// NearestWords as the end of a sentence, `; nearest: "list" or "lint"`; empty if no word is near.
std::string NearestText(std::string_view word, std::span<const std::string> known);

}  // namespace priamos
