#include "robot/core/motion/lane_search.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace priamos::robot {
namespace {

constexpr int kLanes = 81, kMiddle = kLanes / 2;
constexpr double kBesideEnd_m = 0.1;  ///< farther beside the end of the path a way misses it
constexpr int kSteepest = 2;          ///< lanes per step
constexpr double kRounding = 1e-6;
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
constexpr double kMissed =
    50;  ///< per metre beside the end of the path, once: more than the way back there, near things too
constexpr double kSideways = 3;  ///< straight to the side

using Lanes = std::array<double, kLanes>;

double OffsetOf(int lane) {
  return (lane - kMiddle) * kLaneStep_m;
}

int LaneOf(double offset_m) {
  return kMiddle + std::clamp(static_cast<int>(std::lround(offset_m / kLaneStep_m)), -kMiddle, kMiddle);
}

/// The base on the path at one arc length, and where offsets move it.
struct Station {
  double s = 0;
  Eigen::Isometry2d base_from_map;
  Eigen::Vector2d across{
      0, 0};  ///< unit vector to the left of the path, base frame; 0 while turning on the spot
  Leeway leeway;
};

std::vector<Station> StationsBetween(const PathShape& path, double s, double to_m) {
  std::vector<Station> stations;
  const int steps = static_cast<int>((std::min(to_m, path.length()) - s) / kLaneStep_m + kRounding);
  for (int k = 0; k <= std::max(steps, 0); ++k) {
    const double at = s + k * kLaneStep_m;
    const PathShape::Point point = path.At(at);
    const Eigen::Isometry2d base_from_map =
        (Eigen::Translation2d(point.pose.translation()) * Eigen::Rotation2Dd(point.pose.yaw)).inverse();
    stations.push_back({at, base_from_map, base_from_map.linear() * point.left(), path.LeewayAt(at)});
  }
  return stations;
}

/// Offsets for which a thing is within a rectangle around the base, for any size of it.
class Meeting {
 public:
  /// `across`: to the left of the path, `seen`: the thing, both from the base.
  Meeting(const Eigen::Vector2d& across, const Eigen::Vector2d& seen) : seen_(seen) {
    for (int axis = 0; axis < 2; ++axis) {
      per_m_(axis) = std::abs(across(axis)) < 1e-9 ? 0 : 1 / std::abs(across(axis));
      middle_(axis) = across(axis) < 0 ? -seen(axis) * per_m_(axis) : seen(axis) * per_m_(axis);
    }
  }
  /// For the half size `half`; none: first > last.
  std::pair<double, double> Within(const Eigen::Vector2d& half) const {
    std::pair<double, double> meets{-kNowhere, kNowhere};
    for (int axis = 0; axis < 2; ++axis) {
      if (per_m_(axis) == 0) {
        if (std::abs(seen_(axis)) > half(axis)) return {1, 0};
        continue;
      }
      const double reach_m = half(axis) * per_m_(axis);
      meets = {std::max(meets.first, middle_(axis) - reach_m),
               std::min(meets.second, middle_(axis) + reach_m)};
    }
    return meets;
  }

 private:
  Eigen::Vector2d seen_, per_m_, middle_;
};

/// How many things are near to each lane: counted where that begins and ends.
class LaneCount {
 public:
  void Add(const std::pair<double, double>& offsets) {
    // Offsets may be anything where a thing moves almost along the path.
    constexpr double kOutmost = kMiddle + 1;
    const double first = std::clamp(std::ceil(offsets.first / kLaneStep_m), -double(kMiddle), kOutmost);
    const double last = std::clamp(std::floor(offsets.second / kLaneStep_m), -kOutmost, double(kMiddle));
    if (first > last) return;
    ++change_[static_cast<std::size_t>(kMiddle + first)];
    --change_[static_cast<std::size_t>(kMiddle + last + 1)];
  }
  /// Raises the cost of the lanes that something is near to.
  void Raise(Lanes& cost, double to) const {
    int count = 0;
    for (std::size_t lane = 0; lane < cost.size(); ++lane)
      if ((count += change_[lane]) > 0) cost[lane] = std::max(cost[lane], to);
  }

 private:
  std::array<int, kLanes + 1> change_{};
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

/// How far beside the path a way may begin: between there and the path the base may be, to get back.
struct Outmost {
  double left_m = 0, right_m = 0;
};

Outmost OutmostOf(std::span<const std::optional<LaneBegin>> begins) {
  Outmost outmost;
  for (const auto& begin : begins) {
    if (!begin) continue;
    outmost.left_m = std::max(outmost.left_m, begin->offset_m);
    outmost.right_m = std::max(outmost.right_m, -begin->offset_m);
  }
  return outmost;
}

/// Whether no lane leads a base, with `half` its half size and margin, to what is seen there.
bool IsBeyondLanes(const Eigen::Vector2d& across, const Eigen::Vector2d& seen, const Eigen::Vector2d& half) {
  constexpr double kOutmost_m = (kMiddle + 1) * kLaneStep_m;
  return (seen.cwiseAbs() - half - kOutmost_m * across.cwiseAbs()).maxCoeff() > 0;
}

/// What a metre of the path costs beside a station, per lane; kNowhere where the base may not be.
Lanes CostsAt(const LaneSearch& search, const Outmost& outmost, const Station& station) {
  const DetourConfig& config = search.config;
  Lanes near{};
  const Eigen::Vector2d half = search.footprint.Size() / 2;
  const auto margins = MarginsFor(station.leeway, config, search.taken);
  const Eigen::Vector2d widest = half + Eigen::Vector2d::Constant(margins.front().first);
  std::vector<LaneCount> counts(margins.size());
  for (const Eigen::Vector2d& thing : search.things) {
    const Eigen::Vector2d seen = station.base_from_map * thing;
    if (IsBeyondLanes(station.across, seen, widest)) continue;
    const Meeting meeting(station.across, seen);
    for (std::size_t m = 0; m < margins.size(); ++m) {
      const auto offsets = meeting.Within(half + Eigen::Vector2d::Constant(margins[m].first));
      if (offsets.first > offsets.second) break;  // with smaller margins neither
      counts[m].Add(offsets);
    }
  }
  for (std::size_t m = 0; m < margins.size(); ++m) counts[m].Raise(near, margins[m].second);
  // Where the path may not be left it is planned to the centimetre: what is near stops the base, and does not
  // keep it off the path.
  if (!station.leeway.any()) near[kMiddle] = 0;
  for (int lane = 0; lane < kLanes; ++lane) {
    const double offset = OffsetOf(lane);
    double& cost = near[static_cast<std::size_t>(lane)];
    cost += 1 + kAside * std::abs(offset) + kOther * std::abs(offset - search.last.At(station.s)) +
            kOutside * OutsideOf(station.leeway, offset);
    if (offset > std::max(station.leeway.left_m, outmost.left_m) ||
        -offset > std::max(station.leeway.right_m, outmost.right_m))
      cost = kNowhere;
  }
  return near;
}

/// Costs to reach every lane of a station, and from which lane of the station before (of the same one, where
/// the base goes straight to the side).
struct Reached {
  Lanes cost{};
  std::array<int, kLanes> from{};
  std::array<bool, kLanes> sideways{}, begins{};

  Reached() { cost.fill(kNowhere); }
  void Offer(int lane, double offered, int from_lane, bool is_sideways) {
    const auto at = static_cast<std::size_t>(lane);
    if (offered >= cost[at]) return;
    cost[at] = offered;
    from[at] = from_lane;
    sideways[at] = is_sideways;
    begins[at] = false;
  }
  /// A way may begin here.
  void Begin(const LaneBegin& begin) {
    const int lane = LaneOf(begin.offset_m);
    const auto at = static_cast<std::size_t>(lane);
    if (begin.cost >= cost[at]) return;
    Offer(lane, begin.cost, lane, false);
    begins[at] = true;
  }
};

void GoSideways(Reached& reached, const Lanes& costs) {
  const auto offer = [&](int lane, int neighbour) {
    const auto to = static_cast<std::size_t>(neighbour);
    if (neighbour < 0 || neighbour >= kLanes || costs[to] == kNowhere) return;
    reached.Offer(neighbour,
                  reached.cost[static_cast<std::size_t>(lane)] + kLaneStep_m * (kSideways + costs[to]), lane,
                  true);
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
        reached.Offer(to, so_far + kLaneStep_m * (cost + kSteep * slope * slope), lane, false);
    }
  }
  return reached;
}

bool IsUnreachable(const Reached& reached) {
  return std::all_of(reached.cost.begin(), reached.cost.end(), [](double cost) { return cost == kNowhere; });
}

/// Whether a way ends beside the end of the path though nothing stands there.
bool MissesFreeEnd(const LaneSearch& search, const Station& end, int lane) {
  const double least_m = search.config.least_m;
  return std::abs(OffsetOf(lane)) > kBesideEnd_m &&
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

/// The way that ends on the last station's `lane`, from where it begins.
LaneWay WayTo(int lane, const std::vector<Reached>& reached, double from_m) {
  std::vector<double> backwards;
  backwards.reserve(reached.size());
  for (std::size_t k = reached.size(); k-- > 0;) {
    const Reached& here = reached[k];
    backwards.push_back(OffsetOf(lane));
    while (here.sideways[static_cast<std::size_t>(lane)]) lane = here.from[static_cast<std::size_t>(lane)];
    if (here.begins[static_cast<std::size_t>(lane)]) break;
    lane = here.from[static_cast<std::size_t>(lane)];
  }
  const auto skipped = static_cast<double>(reached.size() - backwards.size());
  return {from_m + skipped * kLaneStep_m, {backwards.rbegin(), backwards.rend()}};
}

}  // namespace

double MiddleOfLane(double offset_m) {
  return OffsetOf(LaneOf(offset_m));
}

bool IsFree(const LaneSearch& search, double from_m, double to_m) {
  const std::vector<Station> stations = StationsBetween(search.path, from_m, to_m);
  const Eigen::Vector2d half = search.footprint.Size() / 2 + Eigen::Vector2d::Constant(search.config.wish_m);
  return std::none_of(search.things.begin(), search.things.end(), [&](const Eigen::Vector2d& thing) {
    return std::any_of(stations.begin(), stations.end(), [&](const Station& station) {
      const Eigen::Vector2d seen = (station.base_from_map * thing).cwiseAbs();
      return seen.x() <= half.x() && seen.y() <= half.y();
    });
  });
}

std::optional<LaneWay> SearchLanes(const LaneSearch& search, double from_m, double to_m,
                                   std::span<const std::optional<LaneBegin>> begins) {
  const std::vector<Station> stations = StationsBetween(search.path, from_m, to_m);
  const Outmost outmost = OutmostOf(begins);
  std::vector<Reached> reached;
  reached.reserve(stations.size());
  for (std::size_t k = 0; k < stations.size(); ++k) {
    const Lanes costs = CostsAt(search, outmost, stations[k]);
    reached.push_back(k == 0 ? Reached() : GoAhead(reached.back(), costs));
    if (k < begins.size() && begins[k]) reached.back().Begin(*begins[k]);
    GoSideways(reached.back(), costs);
  }
  while (!reached.empty() && IsUnreachable(reached.back())) reached.pop_back();
  if (reached.empty() || (reached.size() < 2 && stations.size() > 1)) return std::nullopt;
  const bool as_far = reached.size() == stations.size();
  const bool to_the_end = as_far && search.path.length() <= to_m;
  const int best = CheapestLane(reached.back().cost, to_the_end ? kMissed : 0);
  LaneWay way = WayTo(best, reached, from_m);
  way.leads_on = as_far && !(to_the_end && MissesFreeEnd(search, stations.back(), best));
  return way;
}

}  // namespace priamos::robot
