#include "planner/core/explore/exploration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/geometry.hpp"
#include "common/learned/edge_walls.hpp"
#include "planner/core/explore/passages.hpp"

namespace priamos::planner {
namespace {

using Cell = ExploredGrid::Cell;
using Eigen::Vector2d;
using Eigen::Vector2i;

/// The trail has a place every so often.
constexpr double kTrail_m = 0.15;
/// A frontier is still at a place when one of its cells is so near.
constexpr double kSamePlace_m = 0.5;
/// What is so near to a place that was given up is given up as well.
constexpr double kGivenUp_m = 0.6;
/// The unknown so near to the way from a frontier to the goal beyond it may be driven over.
constexpr double kOpened_m = 1.2;
/// In which direction a frontier leads is seen from what is unknown so near.
constexpr int kOutwardCells = 5;
/// Middles of cells stand for places that are up to half a diagonal away.
constexpr double kRaster_m = 0.05;

}  // namespace

void ExplorationConfig::Describe(Archive& a) {
  a.Choice("rule", rule, {"cost", "nearest"}, "which frontier is next; nearest is for comparison");
  a.Number("least_frontier_m", least_frontier_m, {"m", 0.1, 5, "a shorter frontier leads nowhere"});
  a.Number("turn_m", turn_m, {"m", 0, 10, "cost of turning by a radian to face a frontier"});
  a.Number("tight_m", tight_m, {"-", 0, 10, "cost per metre that is missing to roomy_m"});
  a.Number("roomy_m", roomy_m, {"m", 0, 3, "distance from what is closed that costs nothing"});
  a.Number("length_gain", length_gain, {"-", 0, 10, "what a metre of frontier is worth"});
  a.Number("most_length_m", most_length_m, {"m", 0, 100, "up to this length of it"});
  a.Number("beyond_m", beyond_m, {"m", 0, 3, "so far into the unknown the base drives"});
  a.Number("farthest_m", farthest_m, {"m", 5, 90, "what lies farther from the start is left"});
  a.Section("grid", grid, "what counts as seen");
}

Exploration::Exploration(const ExplorationConfig& config, double width_m, std::vector<Rectangle> known)
    : config_(config), clearance_m_(width_m / 2 - kRaster_m), known_(std::move(known)) {
  Reset();
}

void Exploration::Reset() {
  evidence_ = {};
  evidence_.things = known_;
  poses_.clear();
  given_up_.clear();
  left_.clear();
  grid_.reset();
  last_.reset();
  driven_m_ = 0;
}

void Exploration::NoteAt(const Pose2& map_from_base) {
  const Vector2d at = map_from_base.translation();
  if (last_) driven_m_ += (at - *last_).norm();
  last_ = at;
  if (!evidence_.trail.empty() && (at - evidence_.trail.back()).norm() < kTrail_m) return;
  evidence_.trail.push_back(at);
  poses_.push_back(map_from_base);
  grid_.reset();
}

void Exploration::Learn(const LearnedWalls& walls) {
  evidence_.walls = WithoutPassages(WithoutEdges(walls), evidence_.trail, clearance_m_ + 2 * kRaster_m);
  grid_.reset();
}

void Exploration::AddThing(const Rectangle& thing) {
  evidence_.things.push_back(thing);
  grid_.reset();
}

void Exploration::GiveUp(const Vector2d& target, std::string reason) {
  given_up_.push_back({target, std::move(reason)});
}

bool Exploration::TryAgain() {
  if (given_up_.empty() && evidence_.things.size() == known_.size()) return false;
  given_up_.clear();
  evidence_.things = known_;
  grid_.reset();
  return true;
}

std::vector<Pose2> Exploration::WayBack(double length_m) const {
  std::vector<Pose2> way;
  double back_m = 0;
  for (std::size_t at = poses_.size(); at > 0 && back_m < length_m;) {
    const Vector2d here = poses_[at - 1].translation();
    // Where it was here for the first time: what it did in between is a loop.
    const auto first = std::find_if(poses_.begin(), poses_.end(), [&](const Pose2& pose) {
      return (pose.translation() - here).norm() < kTrail_m;
    });
    if (first == poses_.begin()) break;
    at = static_cast<std::size_t>(first - poses_.begin());
    way.push_back(poses_[at - 1]);
    back_m += (way.back().translation() - here).norm();
  }
  return way;
}

const ExploredGrid& Exploration::grid() {
  if (!grid_) grid_.emplace(config_.grid, evidence_);
  return *grid_;
}

const Exploration::GivenUp* Exploration::FindGivenUp(const Vector2d& at) const {
  const auto found = std::find_if(given_up_.begin(), given_up_.end(),
                                  [&](const GivenUp& given) { return (given.at - at).norm() < kGivenUp_m; });
  return found == given_up_.end() ? nullptr : &*found;
}

std::optional<FrontierGoal> Exploration::Choose(const Pose2& map_from_base) {
  left_.clear();
  const GridWays ways(grid(), map_from_base.translation(), clearance_m_);
  std::optional<Candidate> best;
  for (const Frontier& frontier : FrontiersOf(*grid_, config_.least_frontier_m)) {
    const auto candidate = Best(frontier, ways, map_from_base);
    if (!candidate) left_.push_back({frontier.middle, frontier.length_m(), WhyLeft(frontier, ways)});
    if (candidate && (!best || candidate->cost < best->cost)) best = candidate;
  }
  std::stable_sort(left_.begin(), left_.end(),
                   [](const auto& a, const auto& b) { return a.length_m > b.length_m; });
  return best ? std::optional(best->goal) : std::nullopt;
}

/// The place of a frontier that costs least; nullopt: none can be reached.
std::optional<Exploration::Candidate> Exploration::Best(const Frontier& frontier, const GridWays& ways,
                                                        const Pose2& base) const {
  std::optional<Candidate> best;
  Vector2i cell(0, 0);
  for (const Vector2i& at : frontier.cells) {
    const Vector2d place = grid_->PlaceOf(at.x(), at.y());
    if (!std::isfinite(ways.Way_m(at)) || ways.Clearance_m(at) < clearance_m_) continue;
    if ((place - evidence_.trail.front()).norm() > config_.farthest_m || FindGivenUp(place)) continue;
    const double cost = CostOf(frontier, at, ways, base);
    if (best && cost >= best->cost) continue;
    best = Candidate{{place, place, ways.Way_m(at), frontier.length_m()}, cost};
    cell = at;
  }
  if (!best) return std::nullopt;
  best->goal.goal = GoalBeyond(cell, ways);
  if (config_.rule == "nearest") best->cost = ways.Way_m(cell);
  return best;
}

double Exploration::CostOf(const Frontier& frontier, const Vector2i& cell, const GridWays& ways,
                           const Pose2& base) const {
  const Vector2d place = grid_->PlaceOf(cell.x(), cell.y());
  if (config_.rule == "nearest") return (place - frontier.middle).norm();
  const Vector2d there = base.Inverse() * place;
  const double turn_rad = std::abs(std::atan2(there.y(), there.x()));
  return ways.Way_m(cell) + config_.turn_m * turn_rad +
         config_.tight_m * std::max(0.0, config_.roomy_m - ways.Clearance_m(cell)) -
         config_.length_gain * std::min(config_.most_length_m, frontier.length_m());
}

std::string Exploration::WhyLeft(const Frontier& frontier, const GridWays& ways) const {
  double widest_m = 0;
  bool near_enough = false;
  for (const Vector2i& at : frontier.cells) {
    const Vector2d place = grid_->PlaceOf(at.x(), at.y());
    if (const GivenUp* given = FindGivenUp(place)) return given->reason;
    widest_m = std::max(widest_m, 2 * ways.Clearance_m(at));
    near_enough = near_enough || (place - evidence_.trail.front()).norm() <= config_.farthest_m;
  }
  if (!near_enough) return fmt::format("farther than {:.0f} m from the start", config_.farthest_m);
  if (widest_m < 2 * clearance_m_)
    return fmt::format("{:.1f} m wide, {:.2f} m needed", widest_m, 2 * (clearance_m_ + kRaster_m));
  return fmt::format("no way of {:.2f} m width leads there", 2 * (clearance_m_ + kRaster_m));
}

/// The direction in which most is unknown around a cell, of length 1; zero when that is even.
Vector2d Exploration::Outward(const Vector2i& cell) const {
  Vector2d sum(0, 0);
  for (int dx = -kOutwardCells; dx <= kOutwardCells; ++dx)
    for (int dy = -kOutwardCells; dy <= kOutwardCells; ++dy)
      if (grid_->At(cell.x() + dx, cell.y() + dy) == Cell::kUnknown) sum += Vector2d(dx, dy);
  return sum.norm() > 1 ? Vector2d(sum.normalized()) : Vector2d(0, 0);
}

/// As far beyond the frontier as nothing is known to be near.
Vector2d Exploration::GoalBeyond(const Vector2i& cell, const GridWays& ways) const {
  const Vector2d target = grid_->PlaceOf(cell.x(), cell.y()), outward = Outward(cell);
  Vector2d goal = target;
  for (double by_m = ExploredGrid::kStep_m; by_m <= config_.beyond_m + 1e-9; by_m += ExploredGrid::kStep_m) {
    const Vector2d next = target + by_m * outward;
    const Vector2i at = grid_->CellOf(next);
    if (!grid_->Holds(at.x(), at.y()) || ways.Clearance_m(at) < clearance_m_) break;
    goal = next;
  }
  return goal;
}

bool Exploration::IsOpen(const FrontierGoal& goal) {
  const auto frontiers = FrontiersOf(grid(), config_.least_frontier_m);
  for (const Frontier& frontier : frontiers)
    for (const Vector2i& cell : frontier.cells)
      if ((grid_->PlaceOf(cell.x(), cell.y()) - goal.target).norm() < kSamePlace_m) return true;
  return false;
}

std::vector<NamedObstacle> Exploration::ObstaclesFor(const FrontierGoal& goal) {
  const ExploredGrid& grid = this->grid();
  const double half_m = ExploredGrid::kStep_m / 2;
  const auto is_border = [&](int x, int y) {
    if (grid.At(x, y) != Cell::kUnknown) return false;
    const bool beside_free = grid.At(x + 1, y) == Cell::kFree || grid.At(x - 1, y) == Cell::kFree ||
                             grid.At(x, y + 1) == Cell::kFree || grid.At(x, y - 1) == Cell::kFree;
    return beside_free && DistanceToSegment(goal.target, goal.goal, grid.PlaceOf(x, y)) > kOpened_m;
  };
  std::vector<NamedObstacle> obstacles;
  for (int y = 0; y < grid.ny(); ++y)
    for (int x = 0; x < grid.nx(); ++x) {
      int end = x;
      while (end < grid.nx() && is_border(end, y)) ++end;
      if (end == x) continue;
      const Vector2d middle = (grid.PlaceOf(x, y) + grid.PlaceOf(end - 1, y)) / 2;
      obstacles.push_back({"what is unknown", {{middle.x(), middle.y(), 0}, {half_m * (end - x), half_m}}});
      x = end;
    }
  for (std::size_t i = known_.size(); i < evidence_.things.size(); ++i)
    obstacles.push_back({"what stopped the robot", evidence_.things[i]});
  return obstacles;
}

}  // namespace priamos::planner
