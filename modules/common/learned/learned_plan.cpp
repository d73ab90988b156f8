#include "common/learned/learned_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "common/learned/edge_walls.hpp"
#include "common/learned/wall_gaps.hpp"

namespace priamos {
namespace {

/// A wall of which one face is known is so thick; two faces of one wall are not nearer or farther apart.
constexpr double kThickness_m = 0.10, kThinnest_m = 0.03, kThickest_m = 0.45;
constexpr double kTurned_rad = Radians(8);
/// A base does not get through less.
constexpr double kNarrowest_m = 0.78;

/// How far behind a face that of the other side lies; nullopt: none was heard.
std::optional<double> ThicknessOf(const LearnedWall& face, const LearnedWalls& learned) {
  std::optional<double> thickness_m;
  for (const LearnedWall& other : learned.walls) {
    const Pose2 there = face.map_from_wall().Inverse() * other.map_from_wall();
    const bool opposite = std::abs(WrapAngle(there.yaw - kPi)) < kTurned_rad;
    const bool beside = std::abs(there.x) < (face.length_m + other.length_m) / 2;
    if (!opposite || !beside || -there.y < kThinnest_m || -there.y > kThickest_m) continue;
    thickness_m = std::min(-there.y, thickness_m.value_or(-there.y));
  }
  return thickness_m;
}

WallPlan WallBehind(const LearnedWall& face, double thickness_m) {
  const Pose2 map_from_wall = face.map_from_wall();
  const Eigen::Vector2d from = map_from_wall * Eigen::Vector2d(-face.length_m / 2, -thickness_m / 2),
                        to = map_from_wall * Eigen::Vector2d(face.length_m / 2, -thickness_m / 2);
  return {fmt::format("learned {}", face.id), {from.x(), from.y()}, {to.x(), to.y()}, thickness_m};
}

DoorPlan DoorIn(const WallGap& gap, int id, double thickness_m) {
  const Pose2 middle = Pose2{gap.x_m, gap.y_m, Radians(gap.yaw_deg)} * Pose2{0, -thickness_m / 2, -kPi / 2};
  DoorPlan door;
  door.id = id;
  door.name = fmt::format("gap {}-{}", gap.before, gap.behind);
  door.x_m = middle.x;
  door.y_m = middle.y;
  door.yaw_deg = Degrees(middle.yaw);
  door.opening_width_m = gap.width_m;
  door.wall_thickness_m = thickness_m;
  door.leaf = "none";
  return door;
}

/// What a plan can hold: not so short that it has no direction, and on the map.
bool FitsPlan(const LearnedWall& wall) {
  constexpr double kShortest_m = 0.01, kMap_m = 100;
  const double farthest_m = std::max(wall.from().cwiseAbs().maxCoeff(), wall.to().cwiseAbs().maxCoeff());
  return wall.length_m >= kShortest_m && farthest_m < kMap_m - 1;
}

/// Of an end of most of the walls, across them, within what a plan takes.
double WallSigma(const LearnedWalls& learned) {
  constexpr double kLeast_m = 0.005, kMost_m = 0.32;
  std::vector<double> sigmas;
  sigmas.reserve(learned.walls.size());
  for (const LearnedWall& wall : learned.walls) sigmas.push_back(wall.SigmaAt(wall.length_m / 2));
  if (sigmas.empty()) return GroundPlan{}.wall_sigma_m;
  const auto middle = sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() / 2);
  std::nth_element(sigmas.begin(), middle, sigmas.end());
  return std::clamp(*middle, kLeast_m, kMost_m);
}

bool IsKnown(const GroundPlan& plan, const DoorPlan& door) {
  return std::any_of(plan.doors.begin(), plan.doors.end(), [&](const DoorPlan& other) {
    return std::hypot(other.x_m - door.x_m, other.y_m - door.y_m) < door.opening_width_m / 2;
  });
}

}  // namespace

GroundPlan PlanOf(const LearnedWalls& told, double fits_m) {
  LearnedWalls learned = WithoutEdges(told);
  std::erase_if(learned.walls, [](const LearnedWall& wall) { return !FitsPlan(wall); });
  GroundPlan plan;
  plan.wall_sigma_m = WallSigma(learned);
  for (const LearnedWall& face : learned.walls)
    plan.walls.push_back(WallBehind(face, ThicknessOf(face, learned).value_or(kThickness_m)));
  for (const WallGap& gap : GapsOf(learned)) {
    if (gap.width_m < kNarrowest_m || gap.width_m >= fits_m) continue;
    const auto before = std::find_if(learned.walls.begin(), learned.walls.end(),
                                     [&](const LearnedWall& wall) { return wall.id == gap.before; });
    DoorPlan door = DoorIn(gap, static_cast<int>(plan.doors.size()) + kFirstLandmarkId,
                           ThicknessOf(*before, learned).value_or(kThickness_m));
    if (!IsKnown(plan, door)) plan.doors.push_back(std::move(door));  // both sides of one wall have the gap
  }
  return plan;
}

}  // namespace priamos
