#include "planner/floor_report.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace priamos::planner {
namespace {

constexpr std::size_t kWalls = 24, kRuns = 100, kFrontiers = 16, kMostParts = 100;

/// `most` of the items from part * most on, each as `make` makes it.
template <class Items, class Made, class Make>
void TakePart(const Items& items, std::size_t part, std::size_t most, std::vector<Made>& made, Make make) {
  const std::size_t end = std::min(items.size(), (part + 1) * most);
  for (std::size_t i = part * most; i < end; ++i) made.push_back(make(items[i]));
}

std::size_t PartsFor(std::size_t items, std::size_t most) {
  return (items + most - 1) / most;
}

floor_wall_t ToMessage(const LearnedWall& wall) {
  const Eigen::Vector2f from = wall.from().cast<float>(), to = wall.to().cast<float>();
  return {from.x(), from.y(), to.x(), to.y()};
}

floor_run_t ToMessage(const SeenFloor::Run& run) {
  return {static_cast<std::int16_t>(run.row), static_cast<std::int16_t>(run.first),
          static_cast<std::int16_t>(run.length)};
}

floor_frontier_t ToMessage(const SeenFloor::Edge& edge) {
  return {static_cast<float>(edge.middle.x()), static_cast<float>(edge.middle.y()),
          static_cast<float>(edge.length_m), static_cast<std::int8_t>(edge.left)};
}

std::size_t CellsOf(const SeenFloor& seen) {
  return std::accumulate(
      seen.free.begin(), seen.free.end(), std::size_t{0},
      [](std::size_t n, const SeenFloor::Run& run) { return n + std::size_t(run.length); });
}

}  // namespace

std::vector<floor_map_t> FloorParts(const LearnedWalls& walls, const std::optional<SeenFloor>& seen,
                                    int revision, Time now) {
  const SeenFloor floor = seen.value_or(SeenFloor{});
  const std::size_t n_parts = std::clamp<std::size_t>(
      std::max({PartsFor(walls.walls.size(), kWalls), PartsFor(floor.free.size(), kRuns),
                PartsFor(floor.edges.size(), kFrontiers)}),
      1, kMostParts);
  const auto make = [](const auto& item) { return ToMessage(item); };
  std::vector<floor_map_t> parts(n_parts);
  for (std::size_t i = 0; i < n_parts; ++i) {
    floor_map_t& part = parts[i];
    part.utime = ToUtime(now);
    part.revision = revision;
    part.part = static_cast<std::int16_t>(i);
    part.n_parts = static_cast<std::int16_t>(n_parts);
    part.cell_m = SeenFloor::kCell_m;
    part.x_m = floor.corner.x();
    part.y_m = floor.corner.y();
    TakePart(walls.walls, i, kWalls, part.walls, make);
    TakePart(floor.free, i, kRuns, part.runs, make);
    TakePart(floor.edges, i, kFrontiers, part.frontiers, make);
    part.n_walls = static_cast<std::int16_t>(part.walls.size());
    part.n_runs = static_cast<std::int16_t>(part.runs.size());
    part.n_frontiers = static_cast<std::int16_t>(part.frontiers.size());
  }
  return parts;
}

void FloorReport::Send(const LearnedWalls& walls, const std::optional<SeenFloor>& seen, Time now) {
  look_.Mark(now);
  const Shown shown{walls.revision, seen ? std::optional(CellsOf(*seen)) : std::nullopt};
  const bool is_known = revision_ > 0;
  if (shown == shown_ && !(is_known && again_.Due(now))) return;
  again_.Mark(now);
  shown_ = shown;
  for (const floor_map_t& part : FloorParts(walls, seen, ++revision_, now)) publisher_.Publish(part);
}

}  // namespace priamos::planner
