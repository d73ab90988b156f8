#include "robot/core/sonar/evidence_grid.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::robot {
namespace {

constexpr double kCell_m = 0.05;
constexpr int kSide = 128;  ///< cells per side in memory: 6.4 m, more than reach to both sides
/// An echo may come from this much before or behind its range.
constexpr double kThick_m = 0.04;
/// What lies less than this before an echo may be the thing itself.
constexpr double kBefore_m = 0.15;
constexpr double kMost = 3;  ///< log odds: what was seen for long is forgotten in seconds when it has gone

int CellOf(double metres) {
  return static_cast<int>(std::floor(metres / kCell_m));
}

Eigen::Vector2d Centre(int x, int y) {
  return {(x + 0.5) * kCell_m, (y + 0.5) * kCell_m};
}

std::size_t Wrapped(int index) {
  return static_cast<std::size_t>(((index % kSide) + kSide) % kSide);
}

}  // namespace

void EvidenceGridConfig::Describe(Archive& a) {
  a.Number("reach_m", reach_m, {"m", 0.5, 3, "echoes from farther away say nothing about a place"});
  a.Number("half_beam_deg", half_beam_deg, {"deg", 1, 30, "an echo lies on an arc of this half width"});
  a.Number("through_deg", through_deg, {"deg", 0, 15, "half width of the part of a beam that clears"});
  a.Number("hit", hit, {"-", 0.05, 3, "log odds for a cell on a narrow arc, per echo"});
  a.Number("miss", miss, {"-", 0.05, 3, "log odds against a cell that a beam goes through"});
  a.Number("sure_arc_m", sure_arc_m, {"m", 0.01, 1, "a wider arc says less of each of its cells"});
  a.Number("thing", thing, {"-", 0.1, 2.9, "log odds from which on a cell is taken for a thing"});
  a.Number("keep_s", keep_s, {"s", 1, 600, "evidence that nothing renews is forgotten"});
}

EvidenceGrid::EvidenceGrid(const EvidenceGridConfig& config)
    : config_(config), cells_(static_cast<std::size_t>(kSide * kSide)) {}

EvidenceGrid::Cell& EvidenceGrid::At(int x, int y) {
  Cell& cell = cells_[Wrapped(y) * kSide + Wrapped(x)];
  if (cell.x != x || cell.y != y) cell = {x, y, 0, {}};
  return cell;
}

void EvidenceGrid::Add(const Pose2& odom_from_sonar, double range_m, Time now) {
  const double far_m = std::min(range_m + kThick_m, config_.reach_m);
  Eigen::Vector2d low = odom_from_sonar.translation(), high = low;
  for (const double side : {-1.0, 0.0, 1.0}) {
    const double bearing = side * Radians(config_.half_beam_deg);
    const Eigen::Vector2d end =
        odom_from_sonar * Eigen::Vector2d(far_m * std::cos(bearing), far_m * std::sin(bearing));
    low = low.cwiseMin(end);
    high = high.cwiseMax(end);
  }
  const Eigen::Isometry2d sonar_from_odom =
      (Eigen::Translation2d(odom_from_sonar.translation()) * Eigen::Rotation2Dd(odom_from_sonar.yaw))
          .inverse();
  const Echo echo{sonar_from_odom, range_m, std::tan(Radians(config_.half_beam_deg)),
                  std::tan(Radians(config_.through_deg))};
  for (int y = CellOf(low.y()); y <= CellOf(high.y()); ++y)
    for (int x = CellOf(low.x()); x <= CellOf(high.x()); ++x) Weigh(x, y, echo, now);
}

void EvidenceGrid::Weigh(int x, int y, const Echo& echo, Time now) {
  const Eigen::Vector2d seen = echo.sonar_from_odom * Centre(x, y);
  const double distance_m = seen.norm(), beside_m = std::abs(seen.y());
  if (distance_m > config_.reach_m || beside_m > echo.beam * seen.x()) return;
  double change = 0;
  if (std::abs(distance_m - echo.range_m) <= kThick_m) {
    const double arc_m = 2 * Radians(config_.half_beam_deg) * echo.range_m;
    change = config_.hit * std::min(1.0, config_.sure_arc_m / arc_m);
  } else if (distance_m < echo.range_m - kBefore_m && beside_m <= echo.through * seen.x()) {
    change = -config_.miss;
  }
  if (change == 0) return;
  Cell& cell = At(x, y);
  if (now - cell.renewed > FromSeconds(config_.keep_s)) cell.log_odds = 0;
  cell.log_odds = std::clamp(cell.log_odds + change, -kMost, kMost);
  cell.renewed = now;
}

std::vector<Eigen::Vector2d> EvidenceGrid::Things(const Pose2& odom_from_base, Time now) const {
  const Pose2 base_from_odom = odom_from_base.Inverse();
  std::vector<Eigen::Vector2d> things;
  for (const Cell& cell : cells_) {
    if (cell.log_odds < config_.thing || now - cell.renewed > FromSeconds(config_.keep_s)) continue;
    const Eigen::Vector2d thing = base_from_odom * Centre(cell.x, cell.y);
    // Cells that are far away have not been touched since their place in memory was left.
    if (thing.norm() < kSide * kCell_m / 2) things.push_back(thing);
  }
  return things;
}

}  // namespace priamos::robot
