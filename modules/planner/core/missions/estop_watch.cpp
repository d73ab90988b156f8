#include "planner/core/missions/estop_watch.hpp"

namespace priamos::planner {

EstopWatch::EstopWatch(const std::optional<DriveReport>& before) {
  if (before) Note(*before);
}

void EstopWatch::Note(const DriveReport& drive) {
  if (!changes_) changes_ = drive.estop_changes;
}

std::optional<std::string> EstopWatch::WhyEnds(const DriveReport& drive) const {
  if (drive.estop) return "the emergency stop is latched; next: priamos estop --rearm, and a new order";
  if (drive.estop_changes != changes())
    return "the emergency stop was pressed or lifted since the order; next: order it again";
  return std::nullopt;
}

}  // namespace priamos::planner
