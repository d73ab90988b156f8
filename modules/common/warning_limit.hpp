#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/rate_limit.hpp"

namespace priamos {

/// Warnings that may come in floods, by what they are about. Of each topic the first is told at once, then
/// one a second at most; what is left out in between is counted, and told with the next one or by itself.
class WarningLimit {
 public:
  /// The sentence to log for this warning; nullopt: it is left out.
  std::optional<std::string> Take(std::string_view topic, std::string_view warning, Time now);
  /// Of each topic of which something was left out a second ago and more, how many.
  std::vector<std::string> LeftOut(Time now);

 private:
  struct Topic {
    RateLimit rate{1};
    int left_out = 0;
  };
  std::map<std::string, Topic, std::less<>> topics_;
};

}  // namespace priamos
