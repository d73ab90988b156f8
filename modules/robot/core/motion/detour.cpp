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

void DetourConfig::Describe(Archive& a) {
  a.Number("horizon_m", horizon_m, {"m", 0.5, 5, "distance ahead on the path"});
  a.Number("least_m", least_m, {"m", 0, 0.5, "nearer to a thing no detour leads"});
  a.Number("stop_m", stop_m, {"m", 0, 0.5, "nearer it leads only to get away"});
  a.Number("wish_m", wish_m, {"m", 0, 1, "nearer to a thing only where there is no room"});
  a.Number("replan_s", replan_s, {"s", 0.02, 5, "time between two searches"});
  if (least_m > stop_m || stop_m > wish_m) a.Refuse("stop_m", "between least_m and wish_m");
}

Detour::Detour(double from, double step, std::vector<double> offsets_m)
    : from_(from), step_(step), offsets_m_(std::move(offsets_m)) {
  leaves_ = std::any_of(offsets_m_.begin(), offsets_m_.end(), [](double offset) { return offset != 0; });
}

double Detour::At(double s) const {
  if (offsets_m_.empty()) return 0;
  const double place = std::clamp((s - from_) / step_, 0.0, static_cast<double>(offsets_m_.size() - 1));
  const auto k = static_cast<std::size_t>(place);
  if (k + 1 == offsets_m_.size()) return offsets_m_.back();
  return offsets_m_[k] + (place - static_cast<double>(k)) * (offsets_m_[k + 1] - offsets_m_[k]);
}

double Detour::SlopeAt(double s) const {
  return (At(s + step_ / 2) - At(s - step_ / 2)) / step_;
}

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
