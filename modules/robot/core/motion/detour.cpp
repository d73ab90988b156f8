#include "robot/core/motion/detour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "robot/core/motion/lane_search.hpp"

namespace priamos::robot {
namespace {

constexpr double kToLane_m = 0.3;  ///< on so much of the path a base gets into the middle of its lane
constexpr double kOnPath_m = 0.1;

/// A base that has not left its path is on it: what it is off is an error, which the follower corrects.
double StartOffset(double offset_m, const Leeway& leeway, const Detour& last) {
  if (!last.leaves() && (!leeway.any() || std::abs(offset_m) < kOnPath_m)) return 0;
  return MiddleOfLane(offset_m);
}

/// A way over lanes begins where the base is, `off_m` beside the middle of its lane.
std::vector<double> BegunBeside(double off_m, std::vector<double> offsets) {
  for (std::size_t k = 0; k < offsets.size(); ++k)
    offsets[k] += off_m * std::max(0.0, 1 - static_cast<double>(k) * kLaneStep_m / kToLane_m);
  return offsets;
}

std::vector<double> Smoothed(const std::vector<double>& offsets) {
  std::vector<double> smooth = offsets;
  for (std::size_t k = 1; k + 1 < offsets.size(); ++k)
    smooth[k] = (offsets[k - 1] + 2 * offsets[k] + offsets[k + 1]) / 4;
  return smooth;
}

}  // namespace

Detour DetourOver(const LaneWay& way, double off_m) {
  auto offsets = Smoothed(Smoothed(way.offsets_m));
  offsets = BegunBeside(std::clamp(off_m, -kLaneStep_m, kLaneStep_m), std::move(offsets));
  return Detour(way.from_m, kLaneStep_m, std::move(offsets)).Leading(way.leads_on);
}

std::optional<Detour> FindDetour(const DetourConfig& config, const Footprint& footprint,
                                 const PathShape& path, const PathPlace& here,
                                 std::span<const Eigen::Vector2d> things, const Detour& last, Things taken) {
  const LaneSearch search{config, footprint, path, things, last, taken};
  const double start_m = StartOffset(here.offset_m, path.LeewayAt(here.s), last);
  const double to_m = here.s + config.horizon_m;
  if (start_m == 0 && IsFree(search, here.s, to_m)) return Detour();
  const std::array<std::optional<LaneBegin>, 1> begins{LaneBegin{start_m, 0}};
  const auto way = SearchLanes(search, here.s, to_m, begins);
  if (!way) return std::nullopt;
  return DetourOver(*way, start_m == 0 ? 0 : here.offset_m - start_m);
}

}  // namespace priamos::robot
