#include "robot/core/motion/back_off.hpp"

#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "robot/core/motion/lane_search.hpp"

namespace priamos::robot {
namespace {

constexpr double kNoted_m = 0.05;  ///< of the driven way, per offset
/// Where another way may branch off: not where the base stands, and not farther back than it may still know
/// of.
constexpr double kLeastBack_m = 0.2, kFarthestBack_m = 4;
/// What a metre back costs, in metres ahead: it is driven more slowly, and once more.
constexpr double kBack = 1.5;
constexpr double kBesideIt_m = 0.1;  ///< beside it by more, a line that may not be left was left
constexpr int kLongestGap = 3;       ///< steps: a base at full speed is noted at every second one

int StepOf(double s) {
  return static_cast<int>(std::lround(s / kNoted_m));
}

/// Distance to the left of the path where the base was at the arc length `s`, unless that line may not be
/// left.
std::optional<double> DrivenAt(const DrivenWay& driven, const PathShape& path, double s) {
  const auto offset_m = driven.At(s);
  const bool may_leave = path.LeewayAt(s).any() || (offset_m && std::abs(*offset_m) > kBesideIt_m);
  return may_leave ? offset_m : std::nullopt;
}

/// The driven way that ends at `here`, a step of a search apart.
Detour DrivenTo(const PathPlace& here, const DrivenWay& driven, const PathShape& path) {
  std::vector<double> backwards{here.offset_m};
  for (double back_m = kLaneStep_m; back_m < kFarthestBack_m && here.s >= back_m; back_m += kLaneStep_m) {
    const auto offset_m = DrivenAt(driven, path, here.s - back_m);
    if (!offset_m) break;
    backwards.push_back(*offset_m);
  }
  const double length_m = static_cast<double>(backwards.size() - 1) * kLaneStep_m;
  return Detour(here.s - length_m, kLaneStep_m, {backwards.rbegin(), backwards.rend()});
}

/// Where another way than that ahead may begin on a driven one; `also_here`: nothing ahead was tried yet.
std::vector<std::optional<LaneBegin>> BeginsOn(const Detour& driven, const PathPlace& here, bool also_here) {
  const auto steps = static_cast<std::size_t>(std::lround((here.s - driven.from()) / kLaneStep_m));
  std::vector<std::optional<LaneBegin>> begins(steps + 1);
  for (std::size_t k = 0; k <= steps; ++k) {
    const double back_m = static_cast<double>(steps - k) * kLaneStep_m;
    if (back_m < kLeastBack_m && !(also_here && k == steps)) continue;
    begins[k] = LaneBegin{driven.At(here.s - back_m), kBack * back_m};
  }
  return begins;
}

}  // namespace

void DrivenWay::Note(const PathPlace& here) {
  offsets_m_[StepOf(here.s)] = here.offset_m;
}

std::optional<double> DrivenWay::At(double s) const {
  const int step = StepOf(s);
  const auto after = offsets_m_.lower_bound(step);
  if (after == offsets_m_.end()) return std::nullopt;
  if (after->first == step) return after->second;
  if (after == offsets_m_.begin()) return std::nullopt;
  const auto before = std::prev(after);
  if (after->first - before->first > kLongestGap) return std::nullopt;
  const double part = double(step - before->first) / (after->first - before->first);
  return before->second + part * (after->second - before->second);
}

std::optional<OtherWay> FindOtherWay(const DetourConfig& config, const Footprint& footprint,
                                     const PathShape& path, const PathPlace& here,
                                     std::span<const Eigen::Vector2d> things, const DrivenWay& driven,
                                     Things taken, bool also_here) {
  const Detour back = DrivenTo(here, driven, path);
  const LaneSearch search{config, footprint, path, things, Detour(), taken};
  const auto way =
      SearchLanes(search, back.from(), here.s + config.horizon_m, BeginsOn(back, here, also_here));
  if (!way || !way->leads_on) return std::nullopt;
  const double begin_m = back.At(way->from_m);
  return OtherWay{way->from_m, back, DetourOver(*way, begin_m - MiddleOfLane(begin_m)), taken};
}

}  // namespace priamos::robot
