#include "planner/core/graph/floor_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/random.hpp"

namespace priamos::planner {
namespace {

using Eigen::Vector2d;

/// A wall as it truly is; whoever hears it has `from` to the right.
struct TrueWall {
  Vector2d from, to;
};

/// Drives over places, hears each wall as it passes it, and errs as wheels do.
class Drive {
 public:
  Drive(std::vector<TrueWall> walls, std::uint64_t seed, double turn_deg, double bias_deg_per_m,
        const FloorGraphConfig& config = {})
      : graph(config),
        walls_(std::move(walls)),
        rng_(Rng::Stream(seed, "drive")),
        turn_deg_(turn_deg),
        bias_deg_per_m_(bias_deg_per_m) {
    graph.NoteAt(believed_, now_s_);
  }

  void To(const Vector2d& place) {
    constexpr double kStep_m = 0.1;
    const Vector2d way = place - true_.translation();
    Turn(std::atan2(way.y(), way.x()));
    const int steps = static_cast<int>(way.norm() / kStep_m);
    for (int i = 0; i < steps; ++i) {
      Move({kStep_m, 0, 0},
           {scale * kStep_m * (1 + 0.002 * rng_.Normal(1)), 0.001 * rng_.Normal(1),
            Radians(bias_deg_per_m_ * kStep_m + turn_deg_ * std::sqrt(kStep_m) * rng_.Normal(1))});
      if (i % 10 == 9) Hear();
    }
  }

  double Off_m() const {
    return (graph.map_from_robot() * believed_.translation() - true_.translation()).norm();
  }
  double Turned_deg() const {
    return Degrees(WrapAngle(graph.map_from_robot().yaw + believed_.yaw - true_.yaw));
  }
  double RawTurned_deg() const { return Degrees(WrapAngle(believed_.yaw - true_.yaw)); }

  /// How far it is off along x.
  double OffAlong_m() const {
    return (graph.map_from_robot() * believed_.translation() - true_.translation()).x();
  }

  FloorGraph graph;
  std::vector<Vector2d> corners;  ///< that are heard, each under a new number when it is passed
  double corner_m = 0.02;         ///< sigma of their places
  double scale = 1;               ///< of the way that the wheels tell

 private:
  void Turn(double to_rad) {
    const double by = WrapAngle(to_rad - true_.yaw);
    Move({0, 0, by}, {0, 0, by + Radians(0.2) * rng_.Normal(1)});
  }

  void Move(const Pose2& truly, const Pose2& as_believed) {
    true_ = true_ * truly;
    believed_ = believed_ * as_believed;
    now_s_ += 0.3;
    graph.NoteAt(believed_, now_s_);
  }

  /// What lies beside the base within 2 m, up to 1 m before and behind it.
  void Hear() {
    for (std::size_t i = 0; i < walls_.size(); ++i) {
      const Vector2d along = (walls_[i].to - walls_[i].from).normalized(), left(-along.y(), along.x());
      const double across_m = left.dot(true_.translation() - walls_[i].from);
      const double at_m = along.dot(true_.translation() - walls_[i].from);
      const double from_m = std::max(0.0, at_m - 1),
                   to_m = std::min((walls_[i].to - walls_[i].from).norm(), at_m + 1);
      const bool beside = std::abs(std::sin(std::atan2(along.y(), along.x()) - true_.yaw)) < 0.5;
      if (across_m < 0.2 || across_m > 2 || to_m - from_m < 0.9 || !beside) continue;
      const Vector2d middle = walls_[i].from + (from_m + to_m) / 2 * along + 0.01 * rng_.Normal(1) * left;
      const Pose2 truly{middle.x(), middle.y(),
                        std::atan2(along.y(), along.x()) + Radians(0.3) * rng_.Normal(1)};
      const Pose2 told = believed_ * true_.Inverse() * truly;
      LearnedWall wall;
      wall.x_m = told.x;
      wall.y_m = told.y;
      wall.yaw_deg = Degrees(told.yaw);
      wall.length_m = to_m - from_m;
      wall.seen_s = now_s_;
      graph.Note({1, ++last_id_, wall});
    }
    HearCorners();
    graph.Settle();
  }

  /// Those that are abeam.
  void HearCorners() {
    for (const Vector2d& corner : corners) {
      const Vector2d there = true_.Inverse() * corner;
      if (std::abs(there.x()) > 0.5 || std::abs(there.y()) > 2) continue;
      const Vector2d told = believed_ * (there + corner_m * Vector2d(rng_.Normal(1), rng_.Normal(1)));
      const double towards_rad = WrapAngle(std::atan2(there.y(), there.x()) + believed_.yaw);
      graph.Note({1, ++last_id_, LearnedPoint{told.x(), told.y(), 0.1, now_s_}, 0.03, towards_rad});
    }
  }

  std::vector<TrueWall> walls_;
  Rng rng_;
  double turn_deg_, bias_deg_per_m_;
  Pose2 true_, believed_;
  double now_s_ = 100;
  int last_id_ = 0;
};

/// A way around a block of 10 m x 6 m between two squares of walls, turned as a whole.
std::vector<TrueWall> Ring(double turned_rad, double skew_rad = 0) {
  const Pose2 by{0, 0, turned_rad};
  const auto wall = [&](double x1, double y1, double x2, double y2, double skew) {
    const Vector2d from(x1, y1), to(x2, y2), middle = (from + to) / 2;
    const Eigen::Matrix2d turn = Pose2{0, 0, skew}.rotation();
    return TrueWall{by * Vector2d(middle + turn * (from - middle)),
                    by * Vector2d(middle + turn * (to - middle))};
  };
  // The base drives on the rectangle (0, 0) .. (10, 6), 1 m from each wall, the outer ones to its right.
  return {wall(-1, -1, 11, -1, skew_rad), wall(11, -1, 11, 7, -skew_rad),
          wall(11, 7, -1, 7, skew_rad),   wall(-1, 7, -1, -1, 0),
          wall(9, 1, 1, 1, -skew_rad),    wall(9, 5, 9, 1, 0),
          wall(1, 5, 9, 5, skew_rad),     wall(1, 1, 1, 5, 0)};
}

void Rounds(Drive& drive, double turned_rad, int rounds) {
  const Pose2 by{0, 0, turned_rad};
  for (int i = 0; i < rounds; ++i)
    for (const Vector2d& corner : {Vector2d(10, 0), Vector2d(10, 6), Vector2d(0, 6), Vector2d(0, 0)})
      drive.To(by * corner);
}

TEST(FloorGraph, KeepsTheHeadingInASquareBuilding) {
  Drive drive(Ring(0.4), 1, 0.4, 0.2);
  Rounds(drive, 0.4, 2);
  EXPECT_GT(std::abs(drive.RawTurned_deg()), 5);
  EXPECT_LT(std::abs(drive.Turned_deg()), 1);
  EXPECT_LT(drive.Off_m(), 0.1);
  EXPECT_TRUE(drive.graph.is_square());
}

TEST(FloorGraph, JoinsWallsThatItMeetsAgain) {
  Drive drive(Ring(0), 2, 0.4, 0);
  Rounds(drive, 0, 2);
  EXPECT_GT(drive.graph.loops(), 8);
  const auto walls = drive.graph.Walls().walls;
  EXPECT_LE(walls.size(), 12U);
}

TEST(FloorGraph, ABuildingThatIsNotSquareIsNotMadeSquare) {
  // A triangle's walls stand at 60 degrees.
  std::vector<TrueWall> walls;
  std::vector<Vector2d> corners{{0, 0}, {12, 0}, {6, 10.392}};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector2d from = corners[i], to = corners[(i + 1) % 3], along = (to - from).normalized();
    walls.push_back({from + Vector2d(along.y(), -along.x()), to + Vector2d(along.y(), -along.x())});
  }
  Drive drive(walls, 3, 0.2, 0);
  for (int i = 0; i < 2; ++i)
    for (std::size_t k : {1U, 2U, 0U}) drive.To(corners[k]);
  EXPECT_FALSE(drive.graph.is_square());
  EXPECT_LT(std::abs(drive.Turned_deg()), 2);
}

TEST(FloorGraph, WallsBesideEachOtherStayTwo) {
  // A niche: the wall steps back by 25 cm.
  Drive drive({{{-1, -1}, {4, -1}}, {{4, -1.25}, {9, -1.25}}, {{9, 1}, {-1, 1}}}, 4, 0.2, 0);
  for (int i = 0; i < 3; ++i) {
    drive.To({8, 0});
    drive.To({0, 0});
  }
  std::vector<double> places;
  for (const LearnedWall& wall : drive.graph.Walls().walls)
    if (wall.y_m < 0) places.push_back(wall.y_m);
  ASSERT_GE(places.size(), 2U);
  for (const double y : places) EXPECT_LT(std::min(std::abs(y + 1), std::abs(y + 1.25)), 0.06);
}

TEST(FloorGraph, AnchorsMoveWithTheMap) {
  Drive drive(Ring(0), 5, 0.4, 0.3);
  const GraphAnchor anchor = drive.graph.AnchorOf({0.5, 0, 0});
  Rounds(drive, 0, 1);
  EXPECT_LT((drive.graph.PlaceOf(anchor).translation() - Vector2d(0.5, 0)).norm(), 0.1);
}

TEST(FloorGraph, ForgetsEverything) {
  Drive drive(Ring(0), 6, 0.4, 0);
  Rounds(drive, 0, 1);
  drive.graph.Reset();
  EXPECT_TRUE(drive.graph.Walls().walls.empty());
  EXPECT_EQ(drive.graph.map_from_robot().x, 0);
}

/// To the end of a corridor and back, with wheels that tell 1.5 % too much on the way back: its walls tell
/// nothing of that.
Drive ThereAndBack(bool with_points, std::vector<Vector2d> corners) {
  FloorGraphConfig config;
  config.points = with_points;
  Drive drive({{{-2, -1}, {22, -1}}, {{22, 1}, {-2, 1}}}, 7, 0.2, 0, config);
  drive.corners = std::move(corners);
  drive.To({18, 0});
  drive.scale = 1.015;
  drive.To({1, 0});
  return drive;
}

TEST(FloorGraph, CornersTellWhereAlongACorridorItIs) {
  const std::vector<Vector2d> corners{{4, -1}, {8, 1}, {12, -1}, {16, 1}};
  EXPECT_GT(std::abs(ThereAndBack(false, corners).OffAlong_m()), 0.15);
  EXPECT_LT(std::abs(ThereAndBack(true, corners).OffAlong_m()), 0.08);
}

TEST(FloorGraph, BothEdgesOfAThinWallStayTwo) {
  Drive drive({{{-2, -1}, {22, -1}}, {{22, 1}, {-2, 1}}}, 7, 0.05, 0);
  drive.corner_m = 0.01;
  for (const double x : {4, 8, 12, 16})
    for (const double y : {-1.0, -1.14}) drive.corners.emplace_back(x, y);
  drive.To({18, 0});
  drive.To({1, 0});
  const PoseGraph& graph = drive.graph.graph();
  ASSERT_GE(graph.points(), 16);
  for (int i = 0; i + 1 < graph.points(); i += 2)
    EXPECT_NEAR((graph.point(i) - graph.point(i + 1)).norm(), 0.14, 0.05) << "heard one after the other";
}

/// An opening in a wall of 14 cm: what is heard of it in the corridor and in the room behind is not the same.
TEST(FloorGraph, EdgesFoundFromBothSidesOfAWallStayTwo) {
  const double wall_m = 0.14, from_corridor_m = -1, from_room_m = from_corridor_m - wall_m;
  Drive drive({{{-2, from_corridor_m}, {4, from_corridor_m}},
               {{22, 1}, {-2, 1}},
               {{4, from_room_m}, {-2, from_room_m}}},
              9, 0.1, 0);
  drive.corner_m = 0.005;
  drive.corners = {{4, from_corridor_m}};
  drive.To({6, 0});
  drive.corners.clear();
  drive.To({6, -2.1});
  drive.corners = {{4, from_room_m}};
  drive.To({1, -2.1});
  std::vector<double> places;
  const PoseGraph& graph = drive.graph.graph();
  for (int i = 0; i < graph.points(); ++i) places.push_back(graph.point(i).y());
  ASSERT_GE(places.size(), 2U);
  EXPECT_NEAR(*std::max_element(places.begin(), places.end()), from_corridor_m, 0.05);
  EXPECT_NEAR(*std::min_element(places.begin(), places.end()), from_room_m, 0.05);
}

TEST(FloorGraph, WhatStandsElsewhereByNowIsNotTheSame) {
  Drive drive({{{-2, -1}, {22, -1}}, {{22, 1}, {-2, 1}}}, 8, 0.2, 0);
  drive.corners = {{4, -1}, {12, -1}};
  drive.To({18, 0});
  drive.corners = {{4.4, -1}, {12.3, -1}};
  drive.To({1, 0});
  EXPECT_LT(std::abs(drive.OffAlong_m()), 0.1);
}

TEST(FloorGraph, APointThatHasGoneIsNotOnTheMap) {
  Drive drive({}, 9, 0.2, 0);
  drive.graph.Note({1, 5, LearnedPoint{1, 1, 0.1, 100}, 0.03});
  ASSERT_EQ(drive.graph.Walls().points.size(), 1U);
  drive.graph.Note({1, 5});
  EXPECT_TRUE(drive.graph.Walls().points.empty());
}

/// Whatever the wheels do within what is expected of them, most maps are right after two rounds. 16 of 20
/// are: the others end up to 2.7 degrees turned.
TEST(FloorGraph, ManyDrives) {
  int good = 0;
  constexpr int kDrives = 20;
  for (int seed = 0; seed < kDrives; ++seed) {
    Rng rng = Rng::Stream(static_cast<std::uint64_t>(seed), "ring");
    const double turned = rng.Uniform(-kPi, kPi);
    Drive drive(Ring(turned, rng.Uniform(-0.006, 0.006)), static_cast<std::uint64_t>(100 + seed), 0.4,
                rng.Uniform(-0.25, 0.25));
    Rounds(drive, turned, 2);
    good += drive.Off_m() < 0.15 && std::abs(drive.Turned_deg()) < 1.2;
  }
  EXPECT_GE(good, 15);
}

}  // namespace
}  // namespace priamos::planner
