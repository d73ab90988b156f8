#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "bus/context.hpp"
#include "common/learned/learned_walls.hpp"
#include "common/rate_limit.hpp"
#include "lcmtypes/channels.hpp"
#include "planner/core/explore/seen_floor.hpp"

namespace priamos::planner {

/// The map of the floor for people, in as many messages as it takes; what exceeds 100 of them is left out.
std::vector<floor_map_t> FloorParts(const LearnedWalls& walls, const std::optional<SeenFloor>& seen,
                                    int revision, Time now);

/// Sends the map of the floor when it has changed, every 2 s at most, and every 10 s for who came later.
class FloorReport {
 public:
  explicit FloorReport(bus::Context& context) : publisher_(context.node().Advertise(channels::kFloorMap)) {}

  /// Whether it is time to look at the map.
  bool Due(Time now) const { return look_.Due(now); }
  /// Sends it when it is another one than before, or was not sent for long.
  void Send(const LearnedWalls& walls, const std::optional<SeenFloor>& seen, Time now);

 private:
  /// What tells one map from another.
  struct Shown {
    int walls = 0;                     ///< revision
    std::optional<std::size_t> cells;  ///< that are free

    bool operator==(const Shown&) const = default;
  };

  bus::Publisher<floor_map_t> publisher_;
  RateLimit look_{0.5}, again_{0.1};
  Shown shown_;  ///< at first nothing, which is not worth a message
  int revision_ = 0;
};

}  // namespace priamos::planner
