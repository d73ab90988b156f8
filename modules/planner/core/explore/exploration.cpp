#include "planner/core/explore/exploration.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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
/// A beam, the pose and the time of a report put what was heard so far off.
constexpr double kHeard_m = 0.25;
/// Places on the arc of an echo, beside the one that is told of it.
constexpr std::array kBearings_rad{0.0, Radians(-6), Radians(6), Radians(-12), Radians(12)};
/// What is so near to a place that was given up is given up as well.
constexpr double kGivenUp_m = 0.6;
/// A corner or an edge is taken for half as broad.
constexpr double kPoint_m = 0.02;
/// A way that is no longer than this times, and this more than, the one over what is free is worth it.
constexpr double kDetour = 2, kDetour_m = 3;
/// The unknown so near to the way from a frontier to the goal beyond it may be driven over.
constexpr double kOpened_m = 1.2;

}  // namespace

void ExplorationConfig::Describe(Archive& a) {
  a.Choice("rule", rule, {"tour", "cost", "nearest"}, "which frontier is next; all but tour for comparison");
  a.Number("least_frontier_m", least_frontier_m, {"m", 0.1, 5, "a shorter frontier leads nowhere"});
  a.Number("turn_m", turn_m, {"m", 0, 10, "cost of turning by a radian to face a frontier"});
  a.Number("tight_m", tight_m, {"-", 0, 10, "cost per metre that is missing to roomy_m"});
  a.Number("roomy_m", roomy_m, {"m", 0, 3, "distance from what is closed that costs nothing"});
  a.Number("length_gain", length_gain, {"-", 0, 10, "what a metre of frontier is worth"});
  a.Number("most_length_m", most_length_m, {"m", 0, 100, "up to this length of it"});
  a.Number("sight_m", sight_m, {"m", 0, 5, "what was so near with nothing in between is not worth a drive"});
  a.Number("least_gain_m2", least_gain_m2, {"m2", 0, 5, "where less can be seen nothing is looked at"});
  a.Number("again_gain_m2", again_gain_m2,
           {"m2", 0, 100, "where less can be behind it nothing is looked at again"});
  a.Number("gain_m2_per_m", gain_m2_per_m,
           {"m2/m", 0, 7, "nor where less is for each metre of the way there"});
  a.Number("again_m", again_m, {"m", 0, 1000, "a round over what was left costs so much at most"});
  a.Number("again_share", again_share, {"-", 0, 10, "and this share of what was driven before"});
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
  things_from_.clear();
  given_up_.clear();
  left_.clear();
  Forget();
  last_.reset();
  driven_m_ = 0;
  again_ = false;
}

bool Exploration::NoteAt(const Pose2& map_from_base) {
  const Vector2d at = map_from_base.translation();
  if (last_) driven_m_ += (at - *last_).norm();
  last_ = at;
  if (!evidence_.trail.empty() && (at - evidence_.trail.back()).norm() < kTrail_m) return false;
  evidence_.trail.push_back(at);
  poses_.push_back(map_from_base);
  DropDrivenOver(at);
  Forget();
  return true;
}

void Exploration::MoveTrail(const std::vector<Pose2>& trail) {
  if (trail.empty() || trail.size() != poses_.size()) return;
  const auto moved = [&](std::size_t from) { return trail[from] * poses_[from].Inverse(); };
  for (GivenUp& given : given_up_) given.at = moved(given.from) * given.at;
  for (std::size_t i = 0; i < things_from_.size(); ++i) {
    Rectangle& thing = evidence_.things[known_.size() + i];
    thing.map_from_centre = moved(things_from_[i]) * thing.map_from_centre;
  }
  if (last_) last_ = moved(poses_.size() - 1) * *last_;
  poses_ = trail;
  for (std::size_t i = 0; i < trail.size(); ++i) evidence_.trail[i] = trail[i].translation();
  Forget();
}

std::size_t Exploration::Here() const {
  return poses_.empty() ? 0 : poses_.size() - 1;
}

double Exploration::reached_m() const {
  double most_m = 0;
  for (const Vector2d& at : evidence_.trail) most_m = std::max(most_m, (at - evidence_.trail.front()).norm());
  return most_m;
}

void Exploration::Learn(const LearnedWalls& walls, const std::vector<NamedObstacle>& seen) {
  evidence_.walls = WithoutPassages(WithoutEdges(walls), evidence_.trail, clearance_m_ + 2 * kRaster_m);
  evidence_.edges.clear();
  for (const LearnedPoint& point : walls.points)
    if (!ClosesTrail({{point.x_m, point.y_m, 0}, {kPoint_m, kPoint_m}}))
      evidence_.edges.push_back(point.at());
  evidence_.seen.clear();
  for (const NamedObstacle& thing : seen)
    if (!ClosesTrail(thing.shape)) evidence_.seen.push_back(thing.shape);
  Forget();
}

LearnedWalls Exploration::WallsForWays() {
  LearnedWalls walls = SureParts(evidence_.walls);
  const std::vector<LearnedWall>& presumed = grid().presumed();
  walls.walls.insert(walls.walls.end(), presumed.begin(), presumed.end());
  return walls;
}

bool Exploration::AddThing(Rectangle thing) {
  constexpr int kHalvings = 3;
  for (int i = 0; i < kHalvings && ClosesTrail(thing); ++i) thing.half_m /= 2;
  if (ClosesTrail(thing)) return false;
  evidence_.things.push_back(thing);
  things_from_.push_back(Here());
  Forget();
  return true;
}

/// Whether the base could no longer drive where it was.
bool Exploration::ClosesTrail(const Rectangle& thing) const {
  const double needed_m = clearance_m_ + 2 * kRaster_m;
  return std::any_of(evidence_.trail.begin(), evidence_.trail.end(),
                     [&](const Vector2d& at) { return Distance(thing, at) < needed_m; });
}

/// A thing that reached into the body of the base is none.
void Exploration::DropDrivenOver(const Vector2d& at) {
  for (std::size_t i = things_from_.size(); i-- > 0;) {
    const auto thing = evidence_.things.begin() + std::ptrdiff_t(known_.size() + i);
    if (Distance(*thing, at) > clearance_m_ - kRaster_m) continue;
    evidence_.things.erase(thing);
    things_from_.erase(things_from_.begin() + std::ptrdiff_t(i));
  }
}

bool Exploration::Knows(const Vector2d& heard, const Vector2d& from) const {
  return std::any_of(kBearings_rad.begin(), kBearings_rad.end(), [&](double bearing_rad) {
    return IsKnown(from + Eigen::Rotation2Dd(bearing_rad) * (heard - from));
  });
}

bool Exploration::IsKnown(const Vector2d& heard) const {
  const auto is_wall = [&](const LearnedWall& wall) {
    return DistanceToSegment(wall.from(), wall.to(), heard) < kHeard_m;
  };
  const auto is_thing = [&](const Rectangle& thing) { return Distance(thing, heard) < kHeard_m; };
  const auto is_point = [&](const LearnedPoint& point) { return (point.at() - heard).norm() < kHeard_m; };
  return std::any_of(evidence_.walls.walls.begin(), evidence_.walls.walls.end(), is_wall) ||
         std::any_of(evidence_.walls.points.begin(), evidence_.walls.points.end(), is_point) ||
         std::any_of(evidence_.things.begin(), evidence_.things.end(), is_thing) ||
         std::any_of(evidence_.seen.begin(), evidence_.seen.end(), is_thing);
}

void Exploration::GiveUp(const Vector2d& target, std::string reason, bool for_good) {
  given_up_.push_back({target, std::move(reason), Here(), for_good || again_});
}

bool Exploration::TryAgain() {
  const auto forgotten = std::erase_if(given_up_, [](const GivenUp& given) { return !given.for_good; });
  if (forgotten == 0 && evidence_.things.size() == known_.size()) return false;
  again_ = true;
  evidence_.things = known_;
  things_from_.clear();
  Forget();
  again_from_m2_ = grid().free_m2();
  again_from_m_ = driven_m_;
  return true;
}

/// When the base was there for the first time: a place of the trail.
std::size_t Exploration::FirstAt(const Vector2d& place) const {
  const auto first = std::find_if(poses_.begin(), poses_.end(), [&](const Pose2& pose) {
    return (pose.translation() - place).norm() < kTrail_m;
  });
  return static_cast<std::size_t>(first - poses_.begin());
}

std::vector<Pose2> Exploration::WayOn(double length_m) const {
  std::vector<Pose2> way;
  if (poses_.empty()) return way;
  Vector2d last = poses_.back().translation();
  double on_m = 0;
  for (std::size_t at = FirstAt(last) + 1; at + 1 < poses_.size() && on_m < length_m; ++at) {
    way.push_back(poses_[at]);
    on_m += (way.back().translation() - last).norm();
    last = way.back().translation();
  }
  return way;
}

std::vector<Pose2> Exploration::WayBack(double length_m) const {
  std::vector<Pose2> way;
  double back_m = 0;
  for (std::size_t at = poses_.size(); at > 0 && back_m < length_m;) {
    const Vector2d here = poses_[at - 1].translation();
    at = FirstAt(here);  // what it did in between is a loop
    if (at == 0) break;
    way.push_back(poses_[at - 1]);
    back_m += (way.back().translation() - here).norm();
  }
  return way;
}

const ExploredGrid& Exploration::grid() {
  if (!grid_) grid_.emplace(config_.grid, evidence_);
  return *grid_;
}

const PossibleFloor& Exploration::possible() {
  if (possible_) return *possible_;
  possible_.emplace(grid(), evidence_.trail, clearance_m_, config_.sight_m);
  if (again_) possible_->MeasureRegions();
  return *possible_;
}

double Exploration::LeastGain_m2(double way_m) const {
  if (!again_) return config_.least_gain_m2;
  return std::max({config_.least_gain_m2, config_.again_gain_m2, config_.gain_m2_per_m * way_m});
}

/// What is left of the cost of this round: by then most borders that are left lead nowhere.
double Exploration::MostWay_m() const {
  if (!again_) return std::numeric_limits<double>::infinity();
  return config_.again_m + config_.again_share * again_from_m_ - (driven_m_ - again_from_m_);
}

/// A base that keeps more room around itself than the cells take for enough may have to go around much.
bool Exploration::IsWorth(const FrontierGoal& goal, double length_m) const {
  return length_m <= kDetour * goal.way_m + kDetour_m || goal.gain_m2 >= config_.gain_m2_per_m * length_m;
}

/// What was made of the evidence: it has changed.
void Exploration::Forget() {
  possible_.reset();
  grid_.reset();
}

const Exploration::GivenUp* Exploration::FindGivenUp(const Vector2d& at) const {
  const auto found = std::find_if(given_up_.begin(), given_up_.end(),
                                  [&](const GivenUp& given) { return (given.at - at).norm() < kGivenUp_m; });
  return found == given_up_.end() ? nullptr : &*found;
}

bool Exploration::IsOpen(const FrontierGoal& goal) {
  const auto frontiers = FrontiersOf(grid(), config_.least_frontier_m);
  possible();
  for (const Frontier& frontier : frontiers)
    for (const Vector2i& cell : frontier.cells)
      if ((grid_->PlaceOf(cell.x(), cell.y()) - goal.target).norm() < kSamePlace_m &&
          Gain_m2(cell) >= LeastGain_m2(0))
        return true;
  return false;
}

std::vector<NamedObstacle> Exploration::ThingsForWays() const {
  std::vector<NamedObstacle> things;
  for (std::size_t i = known_.size(); i < evidence_.things.size(); ++i)
    things.push_back({"what stopped the robot", evidence_.things[i]});
  for (const Rectangle& thing : evidence_.seen) things.push_back({"a thing that the head saw", thing});
  for (const Vector2d& edge : evidence_.edges)
    things.push_back({"a corner or an edge", {{edge.x(), edge.y(), 0}, {kPoint_m, kPoint_m}}});
  return things;
}

std::vector<NamedObstacle> Exploration::UnknownFor(const FrontierGoal& goal) {
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
  return obstacles;
}

}  // namespace priamos::planner
