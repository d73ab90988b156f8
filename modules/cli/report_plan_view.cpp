#include "cli/report_plan_view.hpp"

#include <fmt/format.h>

#include <cmath>

#include "cli/report_timeline.hpp"
#include "common/covariance.hpp"
#include "common/rectangle.hpp"

namespace priamos::cli {

using Eigen::Vector2d;
using namespace colours;

namespace {

/// The robot of the paper; only drawn, never reckoned with.
constexpr double kLength_m = 0.95, kWidth_m = 0.78;
/// The belief moves at most 2 cm between two estimates; what is more is a fix.
constexpr double kJump_m = 0.02;

std::vector<Vector2d> Outline(const Rectangle& rectangle) {
  const auto corners = rectangle.Corners();
  return {corners.begin(), corners.end()};
}

}  // namespace

std::vector<Vector2d> FootprintOutline(const Pose2& pose) {
  return Outline({pose, {kLength_m / 2, kWidth_m / 2}});
}

Vector2d PositionOf(const pose_t& pose) {
  return {pose.x_m, pose.y_m};
}
Vector2d PositionOf(const world_truth_t& truth) {
  return {truth.x_m, truth.y_m};
}

Eigen::Matrix2d CovarianceOf(const pose_t& pose) {
  return ToCovariance({pose.sigma_x_m, pose.sigma_y_m, pose.sigma_yaw_rad, pose.rho_x_y, pose.rho_x_yaw,
                       pose.rho_y_yaw})
      .topLeftCorner<2, 2>();
}

Extent ExtentOf(const GroundPlan& plan) {
  if (plan.walls.empty()) return {};
  Extent extent{plan.walls[0].from(), plan.walls[0].from()};
  for (const WallPlan& wall : plan.walls) {
    for (const Vector2d& corner : wall.Shape().Corners()) {
      extent.low = extent.low.cwiseMin(corner);
      extent.high = extent.high.cwiseMax(corner);
    }
  }
  return extent;
}

void DrawFloor(View& view, const Extent& extent) {
  const Vector2d a = extent.low, b = extent.high;
  view.Fill({a, {b.x(), a.y()}, b, {a.x(), b.y()}}, kFloor);
  for (double x = std::ceil(a.x()); x <= b.x(); x += 1) view.Polyline({{x, a.y()}, {x, b.y()}}, kGrid, 1);
  for (double y = std::ceil(a.y()); y <= b.y(); y += 1) view.Polyline({{a.x(), y}, {b.x(), y}}, kGrid, 1);
}

void DrawWalls(View& view, const GroundPlan& plan) {
  for (const WallPlan& wall : plan.walls) view.Fill(Outline(wall.Shape()), kWall);
  for (const DoorPlan& door : plan.doors) {
    const double half = door.opening_width_m / 2;
    for (const double side : {1.0, -1.0}) {
      // Architrave, jamb and rebate as one outline.
      std::vector<Vector2d> profile{{door.FrontX(), half + door.frame_width_m},
                                    {door.FrontX(), half},
                                    {door.StopX(), half},
                                    {door.StopX(), half + door.rebate_width_m},
                                    {door.BackX(), half + door.rebate_width_m},
                                    {door.BackX(), half + door.frame_width_m}};
      for (Vector2d& point : profile) point = door.map_from_door() * Vector2d(point.x(), side * point.y());
      view.Fill(profile, kFrame);
    }
  }
}

void DrawDoorName(View& view, const DoorPlan& door) {
  view.Label(door.map_from_door() * Vector2d(door.BackX(), door.opening_width_m / 2 + door.frame_width_m), 12,
             -6, fmt::format("{}, {:.2f} m", door.name, door.opening_width_m), 12, kFrame);
}

void DrawAxis(View& view, const DoorPlan& door) {
  view.Dashed(door.map_from_door() * Vector2d(-2.5, 0), door.map_from_door() * Vector2d(2, 0), kFaint, 0.8);
}

void DrawTruth(View& view, const RunRecord& record) {
  std::vector<Vector2d> path;
  for (const auto& truth : record.truth) path.push_back(PositionOf(truth));
  view.Polyline(path, kTruth, 3);
}

void DrawBelief(View& view, const RunRecord& record, double width) {
  std::vector<Vector2d> stretch;
  for (const pose_t& pose : record.poses) {
    const Vector2d at = PositionOf(pose);
    if (!stretch.empty() && (at - stretch.back()).norm() > kJump_m) {
      view.Polyline(stretch, kBelief, width);
      view.Arrow(stretch.back(), at, kFix, 2);
      stretch.clear();
    }
    stretch.push_back(at);
  }
  view.Polyline(stretch, kBelief, width);
}

void DrawEllipses(View& view, const RunRecord& record) {
  constexpr double kEvery_m = 0.4;
  const auto draw = [&](const pose_t& pose) {
    const auto outline = EllipseOutline(PositionOf(pose), CovarianceOf(pose), 2);
    view.Fill(outline, kBelief, 0.16);
    view.Polyline(outline, kBelief, 0.8, true);
  };
  const pose_t *last = nullptr, *drawn = nullptr;
  for (const pose_t& pose : record.poses) {
    const bool jump = last && (PositionOf(pose) - PositionOf(*last)).norm() > kJump_m;
    if (jump && last != drawn) draw(*last);
    if (jump || !drawn || (PositionOf(pose) - PositionOf(*drawn)).norm() > kEvery_m) {
      draw(pose);
      drawn = &pose;
    }
    last = &pose;
  }
}

void DrawLooks(View& view, const RunRecord& record, const DoorPlan& door) {
  int number = 0;
  for (const LookSpan& look : LooksOf(record)) {
    const std::int64_t exposure = look.correction.utime_exposure;
    const auto from = TruthAt(record, exposure != 0 ? exposure : look.begin_utime);
    if (!from) continue;
    const double half = door.opening_width_m / 2;
    const double y = look.side == 1 ? half : look.side == 2 ? -half : 0;
    view.Dashed(from->translation(), door.map_from_door() * Vector2d(door.FrontX(), y), kFix, 1.4);
    view.Dot(from->translation(), 11, kFix);
    view.Label(from->translation(), -5, 6, fmt::format("{}", ++number), 12, kPaper, true);
  }
}

void DrawRobot(View& view, const Pose2& pose, Colour colour, double opacity) {
  view.Fill(FootprintOutline(pose), colour, opacity);
  view.Polyline(FootprintOutline(pose), colour, 1.6, true);
  view.Arrow(pose * Vector2d(0.12, 0), pose * Vector2d(0.40, 0), colour, 1.6);
}

void DrawRobots(View& view, const RunRecord& record, const Pose2& map_from_door) {
  if (!record.truth.empty()) {
    if (const auto start = TruthAt(record, record.truth.front().utime)) DrawRobot(view, *start, kTruth, 0.10);
    if (const auto end = TruthAt(record, record.truth.back().utime)) DrawRobot(view, *end, kTruth, 0.10);
  }
  if (!record.poses.empty()) {
    const pose_t& pose = record.poses.front();
    view.Polyline(FootprintOutline({pose.x_m, pose.y_m, pose.yaw_rad}), kBelief, 1.2, true);
  }
  if (const auto crossing = CrossingOf(record, map_from_door))
    if (const auto at = TruthAt(record, crossing->utime)) DrawRobot(view, *at, kTruth, 0.16);
}

}  // namespace priamos::cli
