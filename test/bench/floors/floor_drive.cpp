#include "test/bench/floors/floor_drive.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

#include "test/bench/figures.hpp"

namespace priamos::bench {
namespace {

using Eigen::Vector2d;
using planner::FrontierGoal;

/// The base needs a passage of that width.
constexpr double kWidth_m = 0.98;
/// So often the frontier ahead is looked at: 2.5 s at 0.3 m/s.
constexpr double kReconsider_m = 0.75;
constexpr double kThere_m = 0.25, kThing_m = 0.3;
constexpr int kRetries = 2, kMostLegs = 1500;

}  // namespace

FloorDrive::FloorDrive(const cli::TrueWorld& world, const Vector2d& start, std::uint64_t seed,
                       const planner::ExplorationConfig& config)
    : floor_(world, start),
      heard_(world, floor_, seed),
      exploration_(config, kWidth_m, {}),
      base_{start.x(), start.y(), 0} {
  exploration_.NoteAt(base_);
  floor_.SeeFrom(start);
  heard_.HearFrom(start, 0);
}

void FloorDrive::Run(int rounds) {
  double most_m2 = 0;
  int round = 0;
  while (legs_.size() < std::size_t(kMostLegs)) {
    const double since_s = CpuSeconds();
    exploration_.Learn(heard_.Told());
    const auto goal = exploration_.Choose(base_);
    choosing_s_ += CpuSeconds() - since_s;
    if (goal) {
      DriveTo(*goal);
      continue;
    }
    const double seen_m2 = exploration_.grid().free_m2();
    if (seen_m2 > most_m2 + 1) round = 0;
    most_m2 = std::max(most_m2, seen_m2);
    if (++round > rounds || !exploration_.TryAgain()) return;
    again_ = true;
  }
}

double FloorDrive::DrivenUntil(double seen) const {
  const auto first =
      std::find_if(seen_.begin(), seen_.end(), [&](const auto& at) { return at.second >= seen; });
  return first == seen_.end() ? driven_m_ : first->first;
}

void FloorDrive::DriveTo(const FrontierGoal& goal) {
  if ((last_target_ - goal.target).norm() > 0.1) missed_ = 0;
  last_target_ = goal.target;
  legs_.push_back({driven_m_, 0, floor_.seen(), 0, goal.target, goal.length_m, again_});
  const auto way = WayTo(goal.goal);
  const bool leads_there = double(way.size()) * cli::TrueFloor::kStep_m <= 1.5 * (goal.way_m + 1) + 1.5;
  const bool closed = leads_there && Follow(way, goal);
  legs_.back().to_m = driven_m_;
  legs_.back().seen_to = floor_.seen();
  if (closed) return;
  exploration_.Learn(heard_.Told());
  if (!exploration_.IsOpen(goal)) return;
  if ((base_.translation() - goal.goal).norm() < kThere_m)
    exploration_.GiveUp(goal.target, "seen from near by", true);
  else
    StopBefore(goal);
}

void FloorDrive::StopBefore(const FrontierGoal& goal) {
  const Vector2d off = goal.goal - base_.translation();
  const Vector2d at = base_.translation() + std::min(0.75, off.norm()) * off.normalized();
  exploration_.AddThing({{at.x(), at.y(), std::atan2(off.y(), off.x())}, {kThing_m / 2, kThing_m / 2}});
  const bool moved = legs_.back().to_m > legs_.back().from_m;
  if (++missed_ <= kRetries && moved) return;
  missed_ = 0;
  exploration_.GiveUp(goal.target, "blocked");
}

/// Returns whether the frontier was none any more on the way.
bool FloorDrive::Follow(const std::vector<Vector2d>& way, const FrontierGoal& goal) {
  double since_m = driven_m_;
  for (const Vector2d& at : way) {
    Step(at);
    if (driven_m_ - since_m <= kReconsider_m) continue;
    since_m = driven_m_;
    exploration_.Learn(heard_.Told());
    if (!exploration_.IsOpen(goal)) return true;
  }
  return false;
}

void FloorDrive::Step(const Vector2d& to) {
  driven_m_ += (to - base_.translation()).norm();
  base_ = {to.x(), to.y(), std::atan2(to.y() - base_.y, to.x() - base_.x)};
  floor_.SeeFrom(to);
  seen_.emplace_back(driven_m_, floor_.seen());
  exploration_.NoteAt(base_);
  heard_.HearFrom(to, driven_m_);
}

/// The shortest true way, as near as one leads.
std::vector<Vector2d> FloorDrive::WayTo(const Vector2d& to) const {
  using Open = std::pair<float, int>;
  const int nx = floor_.nx(), start = floor_.IndexAt(base_.translation());
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  std::vector<float> way_m(floor_.cells(), 1e9F);
  std::vector<int> from(floor_.cells(), start);
  const auto place = [&](int cell) { return floor_.PlaceOf(cell % nx, cell / nx); };
  int best = start;
  way_m[std::size_t(start)] = 0;
  for (open.push({0.0F, start}); !open.empty();) {
    const auto [at_m, at] = open.top();
    open.pop();
    if (at_m > way_m[std::size_t(at)]) continue;
    if ((place(at) - to).norm() < (place(best) - to).norm() - 1e-9) best = at;
    if ((place(best) - to).norm() < 0.08) break;
    for (int i = 0; i < 9; ++i) {
      const int x = at % nx + i % 3 - 1, y = at / nx + i / 3 - 1, next = y * nx + x;
      if (x < 0 || y < 0 || x >= nx || y >= floor_.ny() || !floor_.HasMiddle(std::size_t(next))) continue;
      const auto total_m = at_m + float(cli::TrueFloor::kStep_m * std::hypot(i % 3 - 1, i / 3 - 1));
      if (total_m >= way_m[std::size_t(next)]) continue;
      way_m[std::size_t(next)] = total_m;
      from[std::size_t(next)] = at;
      open.push({total_m, next});
    }
  }
  std::vector<Vector2d> way;
  for (int at = best; at != start; at = from[std::size_t(at)]) way.insert(way.begin(), place(at));
  return way;
}

}  // namespace priamos::bench
