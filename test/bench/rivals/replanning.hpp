#pragma once

#include <optional>

#include "lcmtypes/channels.hpp"
#include "planner/core/path/route_planner.hpp"
#include "test/bench/rivals/driver.hpp"

namespace priamos::bench {

/// What mission `goto` does while the robot drives: a path that ended beside the goal is planned anew, and so
/// is one on which the robot was blocked for 3 s, with a thing of 50 cm on the map where it was; three times.
class Replanning {
 public:
  explicit Replanning(const Order& order)
      : planner_({}, {}, order.plan),
        goal_(order.path.points.back()),
        start_(order.start),
        path_(order.path) {}

  /// The next path, where one is due; a pose as the robot reports it.
  std::optional<robot::Path> Next(const drive_status_t& status, const Pose2& map_from_base, Time now);

 private:
  bool IsDue(const drive_status_t& status, const Pose2& map_from_base, Time now);
  void AddThing(const drive_status_t& status, const Pose2& map_from_base);

  planner::RoutePlanner planner_;
  Pose2 goal_, start_;
  robot::Path path_;
  std::optional<Time> blocked_since_;
  int departures_ = 0;
};

}  // namespace priamos::bench
