#include "planner/core/explore/explored_grid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

namespace priamos::planner {
namespace {

using Eigen::Vector2d;

/// Lines are followed in such steps: no cell on them is left out that is crossed by more than its corner.
constexpr double kAlong_m = 0.05;
/// A wall is closed from its face so far backwards: no line slips through it between two cells.
constexpr double kThick_m = 0.15;
/// So much of either end of a wall is doubted at most.
constexpr double kMostDoubt_m = 0.2;
/// Places around the base are looked at so far apart at the border of what is near.
constexpr double kRim_m = 0.08;
/// Where the base was nothing is: so far to each side of its centre, less than half of its width.
constexpr double kBody_m = 0.3;
/// What is near is opened from places so far apart: more of them see no more.
constexpr double kApart_m = 0.25;
/// A base hears a wall over several places; one this much farther than the nearest tells nothing new.
constexpr double kBeyond_m = 0.3;

}  // namespace

void ExploredGridConfig::Describe(Archive& a) {
  a.Number("near_m", near_m, {"m", 0.7, 3, "what is so near to the base is seen, up to walls"});
  a.Number("wall_reach_m", wall_reach_m,
           {"m", 0.7, 5, "what is before a wall that was told is seen from so far"});
  a.Number("facing_deg", facing_deg, {"deg", 5, 80, "and so far off the perpendicular of the wall"});
  a.Section("presumed", presumed, "where walls go on although nobody told so");
}

ExploredGrid::ExploredGrid(const ExploredGridConfig& config, const ExploredEvidence& evidence)
    : presumed_(PresumedWalls(evidence.walls, evidence.trail, config.presumed)), edges_(evidence.edges) {
  Eigen::AlignedBox2d box;
  for (const Vector2d& at : evidence.trail) box.extend(at);
  if (box.isEmpty()) return;
  const double beyond_m = std::max(config.near_m, config.wall_reach_m) + 2 * kStep_m;
  origin_ = (box.min().array() - beyond_m) / kStep_m;
  origin_ = kStep_m * origin_.array().floor();
  const Vector2d size = box.max().array() + beyond_m - origin_.array();
  nx_ = static_cast<int>(std::ceil(size.x() / kStep_m));
  ny_ = static_cast<int>(std::ceil(size.y() / kStep_m));
  cells_.assign(std::size_t(nx_) * std::size_t(ny_), Cell::kUnknown);
  Close(evidence);
  std::optional<Vector2d> last;  // the newest counts always
  for (auto at = evidence.trail.rbegin(); at != evidence.trail.rend(); ++at) {
    if (last && (*at - *last).norm() < kApart_m) continue;
    OpenAround(*at, config.near_m);
    last = *at;
  }
  for (const LearnedWall& wall : evidence.walls.walls) OpenToWall(config, wall, evidence.trail);
  OpenWhereItWas(evidence.trail);
}

Eigen::Vector2i ExploredGrid::CellOf(const Vector2d& in_map) const {
  const Vector2d at = (in_map - origin_) / kStep_m;
  return {static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y()))};
}

ExploredGrid::Cell ExploredGrid::At(const Vector2d& in_map) const {
  const Eigen::Vector2i cell = CellOf(in_map);
  return At(cell.x(), cell.y());
}

ExploredGrid::Cell* ExploredGrid::Find(const Vector2d& in_map) {
  const Eigen::Vector2i cell = CellOf(in_map);
  return Holds(cell.x(), cell.y()) ? &cells_[IndexOf(cell.x(), cell.y())] : nullptr;
}

double ExploredGrid::free_m2() const {
  return kStep_m * kStep_m * static_cast<double>(std::count(cells_.begin(), cells_.end(), Cell::kFree));
}

void ExploredGrid::Close(const ExploredEvidence& evidence) {
  for (const LearnedWall& wall : evidence.walls.walls) CloseWall(wall, false);
  for (const LearnedWall& piece : presumed_) CloseWall(piece, true);
  for (const auto* things : {&evidence.things, &evidence.seen})
    for (const Rectangle& thing : *things) CloseThing(thing);
}

/// One that is presumed is doubtful as a whole.
void ExploredGrid::CloseWall(const LearnedWall& wall, bool presumed) {
  const Pose2 map_from_wall = wall.map_from_wall();
  const double half_m = wall.length_m / 2;
  const double sure_m = presumed ? -1 : half_m - std::min({2 * wall.sigma_end_m, kMostDoubt_m, half_m / 2});
  for (double along_m = -half_m;; along_m += kAlong_m) {
    along_m = std::min(along_m, half_m);
    const bool sure = std::abs(along_m) <= sure_m;
    for (double behind_m = 0; behind_m <= kThick_m; behind_m += kAlong_m) {
      Cell* cell = Find(map_from_wall * Vector2d(along_m, -behind_m));
      if (cell && (sure || *cell == Cell::kUnknown)) *cell = sure ? Cell::kClosed : Cell::kDoubtful;
    }
    if (along_m >= half_m) return;
  }
}

void ExploredGrid::CloseThing(const Rectangle& thing) {
  const Vector2d half = thing.half_m.cwiseMax(kAlong_m);
  const int nx = static_cast<int>(std::ceil(2 * half.x() / kAlong_m)),
            ny = static_cast<int>(std::ceil(2 * half.y() / kAlong_m));
  for (int i = 0; i <= nx; ++i)
    for (int k = 0; k <= ny; ++k) {
      const Vector2d at(half.x() * (2.0 * i / nx - 1), half.y() * (2.0 * k / ny - 1));
      if (Cell* cell = Find(thing.map_from_centre * at)) *cell = Cell::kClosed;
    }
}

void ExploredGrid::OpenLine(const Vector2d& from, const Vector2d& to) {
  const double length_m = (to - from).norm();
  const int steps = std::max(1, static_cast<int>(std::ceil(length_m / kAlong_m)));
  for (int i = 0; i <= steps; ++i) {
    Cell* cell = Find(from + (to - from) * (double(i) / steps));
    if (!cell || *cell == Cell::kClosed || *cell == Cell::kDoubtful) return;
    *cell = Cell::kFree;
  }
}

void ExploredGrid::OpenAround(const Vector2d& base, double near_m) {
  const int rays = static_cast<int>(std::ceil(2 * kPi * near_m / kRim_m));
  for (int i = 0; i < rays; ++i) {
    const double angle = 2 * kPi * i / rays;
    OpenLine(base, base + near_m * Vector2d(std::cos(angle), std::sin(angle)));
  }
}

/// From the nearest places that a piece of wall faces, up to it.
void ExploredGrid::OpenToWall(const ExploredGridConfig& config, const LearnedWall& wall,
                              const std::vector<Vector2d>& trail) {
  const Pose2 wall_from_map = wall.map_from_wall().Inverse();
  const double slope = std::tan(Radians(config.facing_deg));
  std::vector<Vector2d> beside;  // in the wall's frame, the wall along x
  for (const Vector2d& at : trail) {
    const Vector2d local = wall_from_map * at;
    const double reach_m = wall.length_m / 2 + config.wall_reach_m * slope;
    if (local.y() > 0 && local.y() <= config.wall_reach_m && std::abs(local.x()) <= reach_m)
      beside.push_back(local);
  }
  for (double along_m = -wall.length_m / 2; along_m <= wall.length_m / 2; along_m += kAlong_m) {
    std::optional<double> nearest_m;
    const auto faces = [&](const Vector2d& at) { return std::abs(at.x() - along_m) <= slope * at.y(); };
    for (const Vector2d& at : beside)
      if (faces(at)) nearest_m = std::min(at.y(), nearest_m.value_or(at.y()));
    for (const Vector2d& at : beside)
      if (nearest_m && faces(at) && at.y() <= *nearest_m + kBeyond_m)
        OpenLine(wall.map_from_wall() * at, wall.map_from_wall() * Vector2d(along_m, 0));
  }
}

void ExploredGrid::OpenWhereItWas(const std::vector<Vector2d>& trail) {
  for (const Vector2d& at : trail)
    for (double dx = -kBody_m; dx <= kBody_m; dx += kStep_m)
      for (double dy = -kBody_m; dy <= kBody_m; dy += kStep_m)
        if (std::hypot(dx, dy) <= kBody_m)
          if (Cell* cell = Find(at + Vector2d(dx, dy))) *cell = Cell::kFree;
}

}  // namespace priamos::planner
