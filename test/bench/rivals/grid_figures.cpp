#include "test/bench/rivals/grid_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/robot/body_size.hpp"
#include "test/bench/figures.hpp"
#include "world/core/scene/outline.hpp"

namespace priamos::bench {
namespace {

constexpr double kSonar_m = 0.4, kBand_m = 0.05;  ///< height of the ring
constexpr double kReach_m = 1.5, kNear_m = 0.1, kApart_m = 0.05;
constexpr int kStepsPerJudgement = 25;

/// Places along the sides of a rectangle, just outside of it.
void AddPlaces(const Rectangle& outline, std::vector<Eigen::Vector2d>& places) {
  const auto corners = outline.Corners();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d side = corners[(i + 1) % corners.size()] - corners[i];
    const int n = std::max(1, int(side.norm() / kApart_m));
    const Eigen::Vector2d out = 0.001 * Eigen::Vector2d(side.y(), -side.x()).normalized();
    for (int k = 0; k < n; ++k) places.push_back(corners[i] + (k + 0.5) / n * side + out);
  }
}

bool AnyNear(const std::vector<Eigen::Vector2d>& things, const Eigen::Vector2d& at) {
  return std::any_of(things.begin(), things.end(),
                     [&](const Eigen::Vector2d& thing) { return (thing - at).norm() <= kNear_m; });
}

}  // namespace

GridWatch::GridWatch(const Case& task, const std::vector<GridKind>& kinds, std::vector<GridFigures>& figures)
    : scene_(task.solids, kSonar_m, kBand_m, world::EchoMaterial::Defaults()),
      odometry_({}, {}),
      figures_(figures) {
  for (const world::Solid& solid : task.solids)
    if (world::Overlaps(solid, kSonar_m - kBand_m, kSonar_m + kBand_m)) {
      outlines_.push_back(world::OutlineOf(solid));
      AddPlaces(outlines_.back(), places_);
    }
  for (const GridKind& kind : kinds) grids_.push_back(kind.make());
}

void GridWatch::See(const Heard& heard, const Pose2& map_from_base) {
  if (heard.wheels) {
    const auto& reading = heard.wheels->reading;
    odometry_.Add({heard.wheels->time, reading.position_ticks, reading.deadline_stopped}, heard.wheels->time);
    now_ = heard.wheels->time;
  }
  if (heard.sonars) Add(*heard.sonars);
  if (++steps_ % kStepsPerJudgement == 0) Judge(map_from_base);
}

void GridWatch::Add(const world::SonarSample& sample) {
  const Eigen::Vector2d footprint(kDrawnBody.length_m, kDrawnBody.width_m);
  std::vector<PlacedEcho> echoes;
  for (int i = 0; i < kSonars; ++i)
    if (const double range_m = sample.ranges_m[std::size_t(i)]; range_m > 0)
      echoes.push_back({odometry_.pose() * BaseFromSonar(i, footprint), range_m});
  for (std::size_t k = 0; k < grids_.size(); ++k) {
    const double from_s = CpuSeconds();
    for (const PlacedEcho& echo : echoes) grids_[k]->Add(echo, sample.time);
    figures_[k].adding_s += CpuSeconds() - from_s;
    figures_[k].echoes += double(echoes.size());
  }
}

/// Distance to the nearest thing that is truly there.
double GridWatch::FreeAround(const Eigen::Vector2d& map) const {
  double least_m = 10;
  for (const Rectangle& outline : outlines_) least_m = std::min(least_m, Distance(outline, map));
  return least_m;
}

void GridWatch::Judge(const Pose2& map_from_base) {
  std::vector<std::vector<Eigen::Vector2d>> things;
  for (const auto& grid : grids_) {
    things.push_back(grid->Things(odometry_.pose(), kReach_m + kNear_m, now_));
    for (Eigen::Vector2d& thing : things.back()) thing = map_from_base * thing;
  }
  const Eigen::Vector2d here = map_from_base.translation();
  double free_m2 = 0;
  for (double x = -kReach_m; x < kReach_m; x += kApart_m)
    for (double y = -kReach_m; y < kReach_m; y += kApart_m)
      if (std::hypot(x, y) < kReach_m && FreeAround(here + Eigen::Vector2d(x, y)) > kNear_m)
        free_m2 += kApart_m * kApart_m;
  for (std::size_t k = 0; k < things.size(); ++k) {
    figures_[k].free_m2 += free_m2;
    for (const Eigen::Vector2d& thing : things[k])
      if ((thing - here).norm() < kReach_m && FreeAround(thing) > kNear_m)
        figures_[k].closed_m2 += kApart_m * kApart_m;
  }
  JudgeOutlines(map_from_base, things);
}

void GridWatch::JudgeOutlines(const Pose2& map_from_base,
                              const std::vector<std::vector<Eigen::Vector2d>>& things) {
  const Eigen::Vector2d here = map_from_base.translation();
  for (const Eigen::Vector2d& place : places_) {
    if ((place - here).norm() > kReach_m || !scene_.Visible(here, place)) continue;
    for (std::size_t k = 0; k < things.size(); ++k) {
      figures_[k].outline += 1;
      figures_[k].known += AnyNear(things[k], place);
    }
  }
}

void PrintGrids(const std::vector<GridKind>& kinds, const std::vector<GridFigures>& figures) {
  fmt::print("  {:20} {:>14} {:>18} {:>12} {:>8}\n", "grid", "outline known", "free floor closed",
             "us an echo", "ratio");
  const double first_s = figures.front().adding_s / figures.front().echoes;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const GridFigures& f = figures[k];
    fmt::print("  {:20} {:>12.1f} % {:>16.2f} % {:>12.2f} {:>8.2f}\n", kinds[k].name,
               100 * f.known / f.outline, 100 * f.closed_m2 / f.free_m2, 1e6 * f.adding_s / f.echoes,
               f.adding_s / f.echoes / first_s);
  }
  std::fflush(stdout);
}

}  // namespace priamos::bench
