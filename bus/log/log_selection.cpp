#include "bus/log/log_selection.hpp"

#include <algorithm>

namespace priamos::bus {
namespace {

bool MatchesAny(const std::vector<std::string>& patterns, std::string_view name) {
  return std::any_of(patterns.begin(), patterns.end(),
                     [&](const std::string& pattern) { return MatchesPattern(pattern, name); });
}

}  // namespace

bool MatchesPattern(std::string_view pattern, std::string_view name) {
  // After a mismatch the newest star takes one more character: linear in practice, never exponential.
  std::size_t p = 0, n = 0, star = std::string_view::npos, restart = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      restart = n;
    } else if (p < pattern.size() && pattern[p] == name[n]) {
      ++p;
      ++n;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++restart;
    } else {
      return false;
    }
  }
  return pattern.substr(p).find_first_not_of('*') == std::string_view::npos;
}

bool LogSelection::Wants(std::int64_t utime, std::string_view channel) const {
  if (utime < from_utime || utime >= to_utime) return false;
  return (only.empty() || MatchesAny(only, channel)) && !MatchesAny(without, channel);
}

const std::string& LogSelection::NameOf(const std::string& channel) const {
  const auto found = rename.find(channel);
  return found == rename.end() ? channel : found->second;
}

}  // namespace priamos::bus
