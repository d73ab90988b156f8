#pragma once

#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "planner/core/explore/exploration.hpp"
#include "test/planner/core/learned.hpp"

namespace priamos::planner {

/// A floor of squares of 2 m, and a base that hears perfectly what it passes: a piece of wall is told when
/// the base is before it, 2.5 m away at most, a corner or an edge when it is in sight, 2 m away at most.
/// Where the base is led into a wall it stops before it.
class IdealFloor {
 public:
  static constexpr double kSquare_m = 2, kPiece_m = 1, kHears_m = 2.5, kHearsEdge_m = 2, kNeeds_m = 0.49,
                          kCell_m = 0.1;

  /// The base begins in the middle of the first square.
  explicit IdealFloor(std::vector<std::pair<int, int>> squares)
      : squares_(squares.begin(), squares.end()),
        base_{kSquare_m * (squares.front().first + 0.5), kSquare_m * (squares.front().second + 0.5), 0} {
    for (const auto& [x, y] : squares_) {
      for (const Corner& corner : {Corner{x, y}, {x + 1, y}, {x, y + 1}, {x + 1, y + 1}})
        if (IsCorner(corner)) silent_corners_.insert(corner);
      Side(x, y - 1, {x, y}, {x + 1, y});
      Side(x + 1, y, {x + 1, y}, {x + 1, y + 1});
      Side(x, y + 1, {x + 1, y + 1}, {x, y + 1});
      Side(x - 1, y, {x, y + 1}, {x, y});
    }
    HearFrom(base_.translation());
  }

  const Pose2& base() const { return base_; }
  const LearnedWalls& told() const { return told_; }
  bool Holds(const Eigen::Vector2d& at) const {
    return squares_.contains({int(std::floor(at.x() / kSquare_m)), int(std::floor(at.y() / kSquare_m))});
  }
  /// The middle of the base may be there.
  bool IsFree(const Eigen::Vector2d& at) const {
    for (const double dx : {-kNeeds_m, 0.0, kNeeds_m})
      for (const double dy : {-kNeeds_m, 0.0, kNeeds_m})
        if (!Holds(at + Eigen::Vector2d(dx, dy))) return false;
    return true;
  }

  /// Drives towards a place by the shortest true way, as near as it gets. Returns whether it is there.
  bool Drive(const Eigen::Vector2d& to, Exploration& exploration) {
    for (const Eigen::Vector2d& at : WayTo(to)) {
      base_ = {at.x(), at.y(), std::atan2(at.y() - base_.y, at.x() - base_.x)};
      driven_m_ += kCell_m;
      exploration.NoteAt(base_);
      HearFrom(at);
    }
    return (base_.translation() - to).norm() < 0.2;
  }
  double driven_m() const { return driven_m_; }
  /// Tells what a base hears there.
  void HearFrom(const Eigen::Vector2d& base) {
    std::erase_if(silent_corners_, [&](const Corner& corner) {
      const Eigen::Vector2d at(kSquare_m * corner.first, kSquare_m * corner.second);
      if ((at - base).norm() > kHearsEdge_m || !Sees(base, at)) return false;
      told_.points.push_back({at.x(), at.y(), 0.02, 0});
      return true;
    });
    std::erase_if(silent_, [&](const LearnedWall& wall) {
      const Eigen::Vector2d from = wall.map_from_wall().Inverse() * base;
      if (std::abs(from.x()) > kPiece_m / 2 + 0.1 || from.y() < 0 || from.y() > kHears_m) return false;
      if (!Sees(base, wall.At(0))) return false;
      told_.walls.push_back(wall);
      ++told_.revision;
      return true;
    });
  }

  /// Share of the floor where the base may be that is free in a grid.
  double Covered(const ExploredGrid& grid) const {
    int all = 0, known = 0;
    for (const auto& [x, y] : squares_)
      for (double dx = 0.05; dx < kSquare_m; dx += 0.1)
        for (double dy = 0.05; dy < kSquare_m; dy += 0.1) {
          const Eigen::Vector2d at(kSquare_m * x + dx, kSquare_m * y + dy);
          all += IsFree(at);
          known += IsFree(at) && grid.At(at) == ExploredGrid::Cell::kFree;
        }
    return double(known) / all;
  }

 private:
  using Corner = std::pair<int, int>;

  bool Sees(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
    for (double part = 0.05; part < 0.95; part += 0.05)
      if (!Holds(from + part * (to - from))) return false;
    return true;
  }
  /// Whether walls meet there at an angle.
  bool IsCorner(const Corner& corner) const {
    const auto [x, y] = corner;
    const bool a = squares_.contains({x - 1, y - 1}), b = squares_.contains({x, y - 1}),
               c = squares_.contains({x - 1, y}), d = squares_.contains({x, y});
    return (a != b || c != d) && (a != c || b != d);
  }
  /// A wall with the floor to its left, in pieces, unless the floor goes on there.
  void Side(int x, int y, const Corner& from, const Corner& to) {
    if (squares_.contains({x, y})) return;
    const Eigen::Vector2d a(kSquare_m * from.first, kSquare_m * from.second),
        b(kSquare_m * to.first, kSquare_m * to.second);
    for (double at_m = kPiece_m / 2; at_m < kSquare_m; at_m += kPiece_m) {
      const Eigen::Vector2d middle = a + (b - a) * (at_m / kSquare_m);
      LearnedWall wall =
          WallAt(middle.x(), middle.y(), Degrees(std::atan2(b.y() - a.y(), b.x() - a.x())), kPiece_m);
      wall.id = int(silent_.size()) + 1;
      silent_.push_back(wall);
    }
  }

  std::vector<Eigen::Vector2d> WayTo(const Eigen::Vector2d& to) const {
    using Cell = std::pair<int, int>;
    const auto place = [&](const Cell& c) {
      return Eigen::Vector2d(base_.x + kCell_m * c.first, base_.y + kCell_m * c.second);
    };
    std::map<Cell, Cell> from{{{0, 0}, {0, 0}}};
    std::vector<Cell> open{{0, 0}};
    Cell best{0, 0};
    for (std::size_t i = 0; i < open.size(); ++i) {
      const Cell at = open[i];
      if ((place(at) - to).norm() < (place(best) - to).norm() - 1e-9) best = at;
      for (const auto& [dx, dy] : {Cell{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        const Cell next{at.first + dx, at.second + dy};
        if (from.contains(next) || !IsFree(place(next))) continue;
        from[next] = at;
        open.push_back(next);
      }
    }
    std::vector<Eigen::Vector2d> way;
    for (Cell at = best; at != Cell{0, 0}; at = from[at]) way.insert(way.begin(), place(at));
    return way;
  }

  std::set<Corner> squares_;
  Pose2 base_;
  std::vector<LearnedWall> silent_;
  std::set<Corner> silent_corners_;
  LearnedWalls told_;
  double driven_m_ = 0;
};

}  // namespace priamos::planner
