#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace priamos::bus {

/// True when `name` matches `pattern`, in which `*` stands for any text.
bool MatchesPattern(std::string_view pattern, std::string_view name);

/// Selection of events by time and channel, and new names for channels.
struct LogSelection {
  std::vector<std::string> only;              ///< patterns of channels; empty: all
  std::vector<std::string> without;           ///< patterns of channels to leave out, stronger than `only`
  std::map<std::string, std::string> rename;  ///< channel -> channel
  std::int64_t from_utime = std::numeric_limits<std::int64_t>::min();
  std::int64_t to_utime = std::numeric_limits<std::int64_t>::max();  ///< not included

  bool Wants(std::int64_t utime, std::string_view channel) const;
  const std::string& NameOf(const std::string& channel) const;
};

}  // namespace priamos::bus
