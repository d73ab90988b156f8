#pragma once

#include <optional>
#include <string>

#include "planner/core/missions/mission_types.hpp"

namespace priamos::planner {

/// Whether the emergency stop was used since an order was given: what moves after that is for a person to
/// order anew. The robot counts how often; an order stands on what was reported last before it, else first
/// after it.
class EstopWatch {
 public:
  /// `before`: the newest report when the order was given, if there was one.
  explicit EstopWatch(const std::optional<DriveReport>& before = {});

  /// Takes a report of after the order.
  void Note(const DriveReport& drive);
  /// What the order stands on; 0 before anything was reported.
  int changes() const { return changes_.value_or(0); }
  /// Why the order ends by what is reported now; nullopt: it does not. Not to be waited for.
  std::optional<std::string> WhyEnds(const DriveReport& drive) const;

 private:
  std::optional<int> changes_;
};

}  // namespace priamos::planner
