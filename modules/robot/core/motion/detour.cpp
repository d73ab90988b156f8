#include "robot/core/motion/detour.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace priamos::robot {
namespace {

constexpr double kStep_m = 0.05;   ///< between two places, along the path and beside it
constexpr double kToLane_m = 0.3;  ///< on so much of the path a base gets into the middle of its lane
constexpr int kLanes = 81, kMiddle = kLanes / 2;
constexpr double kOnPath_m = 0.1;
constexpr int kSteepest = 2;  ///< lanes per step
constexpr double kNowhere = std::numeric_limits<double>::infinity();

// Costs per metre of the path, the path itself being 1.
constexpr double kSteep = 0.5;   ///< times the squared slope
constexpr double kAside = 0.3;   ///< per metre beside the path
constexpr double kOther = 0.3;   ///< per metre beside the last detour
constexpr double kTooNear = 40;  ///< nearer to a thing than it stops
constexpr double kNear = 8;      ///< nearer to a thing than wished
/// In a narrow passage, whose jambs seem to be broader than they are: as if they were so much farther off.
constexpr std::array<std::pair<double, double>, 4> kInto{{{0, 100}, {0.05, 200}, {0.1, 400}, {0.15, 800}}};
/// Of a thing that is taken as smaller than it is heard so much counts as free floor, at such a cost.
constexpr double kSmaller_m = 0.1;
constexpr std::array<std::pair<double, double>, 2> kThrough{{{0, 100}, {0.05, 200}}};
constexpr double kOutside = 20;  ///< per metre beyond the leeway
constexpr double kMissed = 20;   ///< per metre beside the end of the path, once: more than the way back there
constexpr double kSideways = 3;  ///< straight to the side

using Lanes = std::array<double, kLanes>;

double OffsetOf(int lane) {
  return (lane - kMiddle) * kStep_m;
}

/// The base on the path at one arc length, and where offsets move it.
struct Station {
  double s = 0;
  Eigen::Isometry2d base_from_map;
  Eigen::Vector2d across{
      0, 0};  ///< unit vector to the left of the path, base frame; 0 while turning on the spot
  Leeway leeway;
};

std::vector<Station> StationsFrom(const PathShape& path, double s, double horizon_m) {
  std::vector<Station> stations;
  const int steps = static_cast<int>(std::min(horizon_m, path.length() - s) / kStep_m);
  for (int k = 0; k <= std::max(steps, 0); ++k) {
    const double at = s + k * kStep_m;
    const PathShape::Point point = path.At(at);
    const Eigen::Isometry2d base_from_map =
        (Eigen::Translation2d(point.pose.translation()) * Eigen::Rotation2Dd(point.pose.yaw)).inverse();
    stations.push_back({at, base_from_map, base_from_map.linear() * point.left(), path.LeewayAt(at)});
  }
  return stations;
}

/// Offsets for which a thing that is `seen` from the base is within a rectangle of the half size `half`
/// around it; none: first > last.
std::pair<double, double> OffsetsThatMeet(const Eigen::Vector2d& across, const Eigen::Vector2d& seen,
                                          const Eigen::Vector2d& half) {
  std::pair<double, double> meets{-kNowhere, kNowhere};
  for (int axis = 0; axis < 2; ++axis) {
    if (std::abs(across(axis)) < 1e-9) {
      if (std::abs(seen(axis)) > half(axis)) return {1, 0};
      continue;
    }
    const double a = (seen(axis) - half(axis)) / across(axis), b = (seen(axis) + half(axis)) / across(axis);
    meets = {std::max(meets.first, std::min(a, b)), std::min(meets.second, std::max(a, b))};
  }
  return meets;
}

void Raise(Lanes& cost, const std::pair<double, double>& offsets, double to) {
  constexpr double kOutmost =
      kMiddle + 1;  // offsets may be anything where a thing moves almost along the path
  const auto first =
      static_cast<int>(std::clamp(std::ceil(offsets.first / kStep_m), -double(kMiddle), kOutmost));
  const auto last =
      static_cast<int>(std::clamp(std::floor(offsets.second / kStep_m), -kOutmost, double(kMiddle)));
  for (int lane = kMiddle + first; lane <= kMiddle + last; ++lane)
    cost[static_cast<std::size_t>(lane)] = std::max(cost[static_cast<std::size_t>(lane)], to);
}

/// What a search is given: see FindDetour.
struct DetourSearch {
  const DetourConfig& config;
  const Footprint& footprint;
  std::span<const Eigen::Vector2d> things;
  const Detour& last;
  double start_m;  ///< offset where it begins; between it and the path the base may be, to get back
  Things taken;
};

/// How far an offset is beyond the leeway.
double OutsideOf(const Leeway& leeway, double offset_m) {
  return std::max({0.0, offset_m - leeway.left_m, -offset_m - leeway.right_m});
}

/// What a metre costs that leads nearer to a thing than each of these distances, the largest first.
std::vector<std::pair<double, double>> MarginsFor(const Leeway& leeway, const DetourConfig& config,
                                                  Things taken) {
  std::vector<std::pair<double, double>> margins{{config.wish_m, kNear}, {config.stop_m, kTooNear}};
  const bool smaller = taken == Things::kSmaller;
  for (const auto& [into_m, cost] : kInto)
    if (leeway.narrow()) margins.emplace_back(config.least_m - into_m, cost);
  for (const auto& [into_m, cost] : kThrough)
    if (!leeway.narrow() && smaller) margins.emplace_back(config.least_m - into_m, cost);
  if (!leeway.narrow()) margins.emplace_back(config.least_m - (smaller ? kSmaller_m : 0), kNowhere);
  return margins;
}

/// What a metre of the path costs beside a station, per lane; kNowhere where the base may not be.
Lanes CostsAt(const DetourSearch& search, const Station& station) {
  const DetourConfig& config = search.config;
  Lanes near{};
  const Eigen::Vector2d half = search.footprint.Size() / 2;
  const auto margins = MarginsFor(station.leeway, config, search.taken);
  for (const Eigen::Vector2d& thing : search.things) {
    const Eigen::Vector2d seen = station.base_from_map * thing;
    for (const auto& [margin_m, cost] : margins) {
      const auto offsets = OffsetsThatMeet(station.across, seen, half + Eigen::Vector2d::Constant(margin_m));
      if (offsets.first > offsets.second) break;  // with smaller margins neither
      Raise(near, offsets, cost);
    }
  }
  // Where the path may not be left it is planned to the centimetre: what is near stops the base, and does not
  // keep it off the path.
  if (!station.leeway.any()) near[kMiddle] = 0;
  for (int lane = 0; lane < kLanes; ++lane) {
    const double offset = OffsetOf(lane);
    double& cost = near[static_cast<std::size_t>(lane)];
    cost += 1 + kAside * std::abs(offset) + kOther * std::abs(offset - search.last.At(station.s)) +
            kOutside * OutsideOf(station.leeway, offset);
    if (offset > std::max(station.leeway.left_m, search.start_m) ||
        -offset > std::max(station.leeway.right_m, -search.start_m))
      cost = kNowhere;
  }
  return near;
}

/// Whether the path itself leads near nothing.
bool IsFree(const DetourSearch& search, const std::vector<Station>& stations) {
  const Eigen::Vector2d half = search.footprint.Size() / 2 + Eigen::Vector2d::Constant(search.config.wish_m);
  return std::none_of(search.things.begin(), search.things.end(), [&](const Eigen::Vector2d& thing) {
    return std::any_of(stations.begin(), stations.end(), [&](const Station& station) {
      const Eigen::Vector2d seen = (station.base_from_map * thing).cwiseAbs();
      return seen.x() <= half.x() && seen.y() <= half.y();
    });
  });
}

/// Costs to reach every lane of a station, and from which lane of the station before (of the same one, where
/// the base goes straight to the side).
struct Reached {
  Lanes cost{};
  std::array<int, kLanes> from{};
  std::array<bool, kLanes> sideways{};

  Reached() { cost.fill(kNowhere); }
  void Offer(int lane, double offered, int from_lane, bool is_sideways) {
    const auto at = static_cast<std::size_t>(lane);
    if (offered >= cost[at]) return;
    cost[at] = offered;
    from[at] = from_lane;
    sideways[at] = is_sideways;
  }
};

void GoSideways(Reached& reached, const Lanes& costs) {
  const auto offer = [&](int lane, int neighbour) {
    const auto to = static_cast<std::size_t>(neighbour);
    if (neighbour < 0 || neighbour >= kLanes || costs[to] == kNowhere) return;
    reached.Offer(neighbour, reached.cost[static_cast<std::size_t>(lane)] + kStep_m * (kSideways + costs[to]),
                  lane, true);
  };
  for (int lane = 0; lane < kLanes; ++lane) offer(lane, lane + 1);
  for (int lane = kLanes - 1; lane >= 0; --lane) offer(lane, lane - 1);
}

Reached GoAhead(const Reached& before, const Lanes& costs) {
  Reached reached;
  for (int lane = 0; lane < kLanes; ++lane) {
    const double so_far = before.cost[static_cast<std::size_t>(lane)];
    if (so_far == kNowhere) continue;
    for (int to = std::max(lane - kSteepest, 0); to <= std::min(lane + kSteepest, kLanes - 1); ++to) {
      const double slope = to - lane, cost = costs[static_cast<std::size_t>(to)];
      if (cost != kNowhere)
        reached.Offer(to, so_far + kStep_m * (cost + kSteep * slope * slope), lane, false);
    }
  }
  GoSideways(reached, costs);
  return reached;
}

bool IsUnreachable(const Reached& reached) {
  return std::all_of(reached.cost.begin(), reached.cost.end(), [](double cost) { return cost == kNowhere; });
}

/// Whether a way ends beside the end of the path though nothing stands there.
bool MissesFreeEnd(const DetourSearch& search, const Station& end, int lane) {
  const double least_m = search.config.least_m;
  return std::abs(OffsetOf(lane)) > kOnPath_m &&
         std::all_of(search.things.begin(), search.things.end(), [&](const Eigen::Vector2d& thing) {
           return search.footprint.Distance(end.base_from_map * thing) > least_m;
         });
}

int CheapestLane(const Lanes& costs, double per_metre_aside) {
  int best = kMiddle;
  double least = kNowhere;
  for (int lane = 0; lane < kLanes; ++lane) {
    const double cost = costs[static_cast<std::size_t>(lane)] + per_metre_aside * std::abs(OffsetOf(lane));
    if (cost < least) least = cost, best = lane;
  }
  return best;
}

/// Offsets from the last station's `lane` back to the first.
std::vector<double> Backwards(const std::vector<Reached>& reached, int lane) {
  std::vector<double> offsets(reached.size());
  for (std::size_t k = reached.size(); k-- > 0;) {
    offsets[k] = OffsetOf(lane);
    while (reached[k].sideways[static_cast<std::size_t>(lane)])
      lane = reached[k].from[static_cast<std::size_t>(lane)];
    lane = reached[k].from[static_cast<std::size_t>(lane)];
  }
  return offsets;
}

/// A base that has not left its path is on it: what it is off is an error, which the follower corrects.
int StartLane(double offset_m, const Leeway& leeway, const Detour& last) {
  if (!last.leaves() && (!leeway.any() || std::abs(offset_m) < kOnPath_m)) return kMiddle;
  return kMiddle + std::clamp(static_cast<int>(std::lround(offset_m / kStep_m)), -kMiddle, kMiddle);
}

/// A way over lanes begins where the base is, `off_m` beside the middle of its lane.
std::vector<double> BegunBeside(double off_m, std::vector<double> offsets) {
  for (std::size_t k = 0; k < offsets.size(); ++k)
    offsets[k] += off_m * std::max(0.0, 1 - static_cast<double>(k) * kStep_m / kToLane_m);
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

std::optional<Detour> FindDetour(const DetourConfig& config, const Footprint& footprint,
                                 const PathShape& path, const PathPlace& here,
                                 std::span<const Eigen::Vector2d> things, const Detour& last, Things taken) {
  const std::vector<Station> stations = StationsFrom(path, here.s, config.horizon_m);
  const int start = StartLane(here.offset_m, stations.front().leeway, last);
  const DetourSearch search{config, footprint, things, last, OffsetOf(start), taken};
  if (start == kMiddle && IsFree(search, stations)) return Detour();
  std::vector<Reached> reached(1);
  reached[0].Offer(start, 0, start, false);
  GoSideways(reached[0], CostsAt(search, stations.front()));
  for (std::size_t k = 1; k < stations.size(); ++k)
    reached.push_back(GoAhead(reached.back(), CostsAt(search, stations[k])));
  while (IsUnreachable(reached.back())) reached.pop_back();
  if (reached.size() < 2 && stations.size() > 1) return std::nullopt;
  const bool to_the_end = path.length() - here.s <= config.horizon_m && reached.size() == stations.size();
  const int best = CheapestLane(reached.back().cost, to_the_end ? kMissed : 0);
  const bool leads_on =
      reached.size() == stations.size() && !(to_the_end && MissesFreeEnd(search, stations.back(), best));
  auto offsets = Smoothed(Smoothed(Backwards(reached, best)));
  if (start != kMiddle && offsets.size() > 1)
    offsets = BegunBeside(std::clamp(here.offset_m - OffsetOf(start), -kStep_m, kStep_m), std::move(offsets));
  return Detour(here.s, kStep_m, std::move(offsets)).Leading(leads_on);
}

}  // namespace priamos::robot
