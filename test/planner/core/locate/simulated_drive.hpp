#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/ground_plan.hpp"
#include "common/random.hpp"
#include "common/rectangle.hpp"
#include "planner/core/locate/driven_way.hpp"
#include "planner/core/locate/leg_choice.hpp"
#include "planner/core/map/wall_faces.hpp"

namespace priamos::planner {

/// A robot that hears faces beside its way, in a building that may hold things that are on no plan: what
/// WayLog makes of a drive, without a robot. A wall is heard where the base is abeam of it, nearer than 4 m
/// with nothing between; a part of them never.
class SimulatedDrive {
 public:
  SimulatedDrive(const GroundPlan& building, std::vector<Rectangle> things, const Pose2& map_from_base,
                 Rng& rng)
      : rng_(rng), things_(std::move(things)), map_from_base_(map_from_base) {
    for (const WallPlan& wall : building.walls) solids_.push_back(wall.Shape());
    for (const Rectangle& thing : things_) solids_.push_back(thing);
    for (const WallFace& face : FacesOf(building)) AddFace(face);
    for (const Rectangle& thing : things_) AddSides(thing);
    way_from_map_ = {rng.Uniform(-20, 20), rng.Uniform(-20, 20), rng.Uniform(-kPi, kPi)};
    trail_ = {map_from_base};
  }

  /// What is known of the drive so far.
  DrivenWay way() const {
    DrivenWay way;
    way.driven_m = driven_m_;
    for (const Pose2& spot : trail_) way.trail.push_back(way_from_map_ * spot);
    for (const Heard& heard : heard_) {
      const double length_m = heard.to_m - heard.from_m;
      if (length_m < 0.6 || heard.missed) continue;
      const Eigen::Vector2d along = heard.face.along(), left(-along.y(), along.x());
      const Eigen::Vector2d middle =
          heard.face.from + (heard.from_m + heard.to_m) / 2 * along + heard.off_m * left;
      const Pose2 in_map{middle.x(), middle.y(), std::atan2(along.y(), along.x()) + heard.turned_rad};
      way.pieces.push_back({way_from_map_ * in_map, length_m, way_from_map_ * heard.heard_from, heard.at_m});
    }
    std::stable_sort(way.pieces.begin(), way.pieces.end(),
                     [](const auto& a, const auto& b) { return a.length_m > b.length_m; });
    return way;
  }

  /// Drives towards a place, frame of the way; false: something is in the way.
  bool Drive(const Pose2& way_from_end) {
    constexpr double kStep_m = 0.1;
    const Pose2 end = way_from_map_.Inverse() * way_from_end;
    const Eigen::Vector2d towards = (end.translation() - map_from_base_.translation()).normalized();
    while ((end.translation() - map_from_base_.translation()).norm() > kStep_m) {
      const Eigen::Vector2d next = map_from_base_.translation() + kStep_m * towards;
      if (!IsFree({next.x(), next.y(), map_from_base_.yaw})) return false;
      map_from_base_ = {next.x(), next.y(), map_from_base_.yaw};
      driven_m_ += kStep_m;
      trail_.push_back(map_from_base_);
      Hear();
    }
    return true;
  }

  /// It has moved there.
  void MoveTo(const Pose2& map_from_base) {
    driven_m_ += (map_from_base.translation() - map_from_base_.translation()).norm();
    map_from_base_ = map_from_base;
    trail_.push_back(map_from_base);
    Hear();
  }
  /// The pieces as a robot tells of them that has its map frame there.
  std::vector<LearnedWall> Told(const Pose2& told_from_map) const {
    std::vector<LearnedWall> walls;
    for (const HeardPiece& piece : way().pieces) {
      const Pose2 at = told_from_map * way_from_map_.Inverse() * piece.way_from_middle;
      LearnedWall wall;
      wall.x_m = at.x;
      wall.y_m = at.y;
      wall.yaw_deg = Degrees(at.yaw);
      wall.length_m = piece.length_m;
      walls.push_back(wall);
    }
    return walls;
  }

  /// Looks around by itself: up to so many legs.
  void LookAround(int legs, const LegChoiceConfig& config = {}) {
    for (int i = 0; i < legs; ++i) {
      const auto leg = ChooseLeg(config, way(), {closed_});
      if (!leg) return;
      const Eigen::Vector2d towards =
          (leg->translation() - (way_from_map_ * map_from_base_).translation()).normalized();
      if (!Drive(*leg)) closed_.push_back({(way_from_map_ * map_from_base_).translation(), towards});
    }
  }

  /// Whether a base stands there.
  bool IsFree(const Pose2& map_from_base) const {
    const Rectangle base{map_from_base, {0.475, 0.39}};
    return std::all_of(solids_.begin(), solids_.end(),
                       [&](const Rectangle& solid) { return Distance(solid, base) > 0.08; });
  }

  const Pose2& truth() const { return map_from_base_; }
  const Pose2& way_from_map() const { return way_from_map_; }

 private:
  struct Heard {
    WallFace face;
    bool missed = false;
    double off_m = 0, turned_rad = 0;
    double from_m = 0, to_m = -1;  ///< along the face; none while to < from
    Eigen::Vector2d heard_from{0, 0};
    double at_m = 0;
  };

  void AddFace(const WallFace& face) {
    heard_.push_back({face, rng_.Chance(0.15), rng_.Normal(0.025), rng_.Normal(0.009)});
  }
  void AddSides(const Rectangle& thing) {
    const auto corners = thing.Corners();
    // Counter-clockwise: from outside each side runs the other way.
    for (std::size_t i = 0; i < 4; ++i) AddFace({corners[(i + 1) % 4], corners[i]});
  }
  void Hear() {
    const Eigen::Vector2d base = map_from_base_.translation();
    for (Heard& heard : heard_) {
      const Eigen::Vector2d along = heard.face.along(), left(-along.y(), along.x());
      const double at_m = along.dot(base - heard.face.from), far_m = left.dot(base - heard.face.from);
      if (at_m < 0 || at_m > heard.face.length_m() || far_m < 0.2 || far_m > 4) continue;
      const Eigen::Vector2d foot = heard.face.from + at_m * along;
      if (IsHidden(base, foot + 0.05 * left)) continue;
      if (heard.to_m < heard.from_m) heard.from_m = heard.to_m = at_m;
      if (at_m < heard.from_m - 0.5 || at_m > heard.to_m + 0.5) continue;  // of another piece
      heard.from_m = std::min(heard.from_m, at_m);
      heard.to_m = std::max(heard.to_m, at_m);
      heard.heard_from = base;
      heard.at_m = driven_m_;
    }
  }
  bool IsHidden(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
    constexpr int kPlaces = 40;
    for (const Rectangle& solid : solids_)
      for (int i = 0; i <= kPlaces; ++i)
        if (Distance(solid, Eigen::Vector2d(from + (to - from) * i / kPlaces)) <= 0) return true;
    return false;
  }

  Rng& rng_;
  std::vector<Rectangle> things_, solids_;
  std::vector<Heard> heard_;
  std::vector<Pose2> trail_;
  std::vector<ClosedWay> closed_;
  Pose2 map_from_base_, way_from_map_;
  double driven_m_ = 0;
};

/// A wall between two places, as thick as they are.
inline WallPlan WallBetween(double x1_m, double y1_m, double x2_m, double y2_m) {
  WallPlan wall;
  wall.name = "wall";
  wall.from_m = {x1_m, y1_m};
  wall.to_m = {x2_m, y2_m};
  return wall;
}

/// A room of this size from the origin on; its walls begin outside.
inline void AddRoom(GroundPlan& plan, const Eigen::Vector2d& low, const Eigen::Vector2d& size) {
  const Eigen::Vector2d a = low - Eigen::Vector2d::Constant(0.07),
                        b = low + size + Eigen::Vector2d::Constant(0.07);
  plan.walls.push_back(WallBetween(a.x(), a.y(), b.x(), a.y()));
  plan.walls.push_back(WallBetween(b.x(), a.y(), b.x(), b.y()));
  plan.walls.push_back(WallBetween(b.x(), b.y(), a.x(), b.y()));
  plan.walls.push_back(WallBetween(a.x(), b.y(), a.x(), a.y()));
}

}  // namespace priamos::planner
