#include "robot/core/motion/back_off.hpp"

#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

namespace priamos::robot {
namespace {

constexpr double kNoted_m = 0.05;  ///< of the driven way, per offset
/// Between two places where a way may branch off, and how many there are: farther back a planner sees better.
constexpr double kBranches_m = 0.2;
constexpr int kBranches = 8;
constexpr double kBesideIt_m = 0.1;  ///< beside it by more, a line that may not be left was left
constexpr int kLongestGap = 3;       ///< steps: a base at full speed is noted at every second one

int StepOf(double s) {
  return static_cast<int>(std::lround(s / kNoted_m));
}

/// The driven way from `from_m` to `here`; nullopt where it was not driven, or may not be left.
std::optional<Detour> Driven(const DrivenWay& driven, const PathShape& path, double from_m,
                             const PathPlace& here) {
  std::vector<double> offsets;
  for (double s = from_m; s < here.s; s += kNoted_m) {
    const auto offset_m = driven.At(s);
    const bool may_leave = path.LeewayAt(s).any() || (offset_m && std::abs(*offset_m) > kBesideIt_m);
    if (!offset_m || !may_leave) return std::nullopt;
    offsets.push_back(*offset_m);
  }
  offsets.push_back(here.offset_m);
  return Detour(from_m, kNoted_m, std::move(offsets));
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
                                     Things tried) {
  for (const Things taken : {Things::kAsHeard, Things::kSmaller}) {
    for (int k = taken == tried || taken == Things::kAsHeard ? 1 : 0; k <= kBranches; ++k) {
      const double back_m = k * kBranches_m, from_m = here.s - back_m;
      if (from_m < 0) break;
      const auto back = Driven(driven, path, from_m, here);
      if (!back) break;
      DetourConfig farther = config;
      farther.horizon_m += back_m;
      const auto onward =
          FindDetour(farther, footprint, path, {from_m, back->At(from_m)}, things, Detour(), taken);
      if (onward && onward->leads_on()) return OtherWay{from_m, *back, *onward, taken};
    }
  }
  return std::nullopt;
}

}  // namespace priamos::robot
