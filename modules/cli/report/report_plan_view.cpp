#include "cli/report/report_plan_view.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "cli/report/report_timeline.hpp"
#include "common/covariance.hpp"
#include "common/time.hpp"

namespace priamos::cli {

using drawing::Font;
using Eigen::AlignedBox2d, Eigen::Vector2d;

namespace {

/// The belief moves at most 2 cm between two estimates; what is more is a fix.
constexpr double kJump_m = 0.02;
constexpr double kArrowHead_px = 16;
/// A path so far from the walls is one of a world that has gone wrong, and floor is shown so far around it.
constexpr double kBuilding_m = 100, kAroundPath_m = 1;

std::vector<Vector2d> Outline(const Rectangle& rectangle) {
  const auto corners = rectangle.Corners();
  return {corners.begin(), corners.end()};
}

AlignedBox2d BoxOf(const GroundPlan& plan) {
  AlignedBox2d box;
  for (const Rectangle& wall : WallShapes(plan))
    for (const Vector2d& corner : wall.Corners()) box.extend(corner);
  return box;
}

Extent ToExtent(const AlignedBox2d& box) {
  return box.isEmpty() ? Extent{} : Extent{box.min(), box.max()};
}

Rectangle ShapeOf(const CupboardPlan& cupboard) {
  return {cupboard.map_from_cupboard() * Pose2{cupboard.depth_m / 2, 0, 0},
          {cupboard.depth_m / 2, cupboard.width_m / 2}};
}

}  // namespace

std::vector<Vector2d> FootprintOutline(const Pose2& pose, const Vector2d& size_m) {
  return Outline({pose, size_m / 2});
}

Vector2d PositionOf(const pose_t& pose) {
  return {pose.x_m, pose.y_m};
}
Vector2d PositionOf(const world_truth_t& truth) {
  return {truth.x_m, truth.y_m};
}

Eigen::Matrix2d CovarianceOf(const pose_t& pose) {
  return CovarianceIn(pose).topLeftCorner<2, 2>();
}

Extent ExtentOf(const GroundPlan& plan) {
  return ToExtent(BoxOf(plan));
}

Extent ExtentOfRun(const GroundPlan& plan, const std::vector<TrueThing>& things, const RunRecord& record) {
  AlignedBox2d box = BoxOf(plan);
  if (box.isEmpty())
    for (const TrueThing& thing : things)
      for (const Vector2d& corner : thing.outline) box.extend(corner);
  if (box.isEmpty()) return {};
  const AlignedBox2d near(box.min().array() - kBuilding_m, box.max().array() + kBuilding_m);
  for (const world_truth_t& truth : record.truth) {
    const Vector2d at = PositionOf(truth);
    if (near.contains(at)) box.extend(AlignedBox2d(at.array() - kAroundPath_m, at.array() + kAroundPath_m));
  }
  return ToExtent(box);
}

void DrawFloor(MapView& view, const Extent& extent) {
  const Vector2d a = extent.low, b = extent.high;
  view.Area(layers::kFloor, {a, {b.x(), a.y()}, b, {a.x(), b.y()}});
  for (double x = std::ceil(a.x()); x <= b.x(); x += 1) view.Line(layers::kGrid, {{x, a.y()}, {x, b.y()}});
  for (double y = std::ceil(a.y()); y <= b.y(); y += 1) view.Line(layers::kGrid, {{a.x(), y}, {b.x(), y}});
}

void DrawPlan(MapView& view, const GroundPlan& plan, bool names) {
  for (const Rectangle& wall : WallShapes(plan)) view.Solid(layers::kWall, wall);
  for (const CupboardPlan& cupboard : plan.cupboards) {
    const auto outline = Outline(ShapeOf(cupboard));
    view.Area(layers::kCupboard, outline);
    if (names) view.Name(outline, cupboard.name, kSmallFont, colours::kWall);
  }
  for (const NoGoPlan& area : plan.no_go) {
    const auto outline = Outline(area.Shape());
    view.Area(layers::kNoGo, outline);
    if (names) view.Name(outline, area.name, kSmallFont, colours::kNoGo);
  }
  for (const DoorPlan& door : plan.doors) {
    for (const Rectangle& part : FrameShapes(door)) view.Solid(layers::kFrame, part);
    const Vector2d post =
        door.map_from_door() * Vector2d(door.BackX(), door.opening_width_m / 2 + door.frame_width_m / 2);
    if (names)
      view.Label(post, fmt::format("{}, {:.2f} m", door.name, door.opening_width_m), kSmallFont,
                 colours::kFrame, 14);
  }
}

void DrawThings(MapView& view, const std::vector<TrueThing>& things, bool names) {
  constexpr double kNamed_m = 0.2;
  constexpr std::size_t kMostNames = 60;  // more hide the floor: the cells of a grid
  for (const TrueThing& thing : things) {
    view.Area(layers::kThing, thing.outline);
    const double diagonal_m = (thing.outline.at(2) - thing.outline.at(0)).norm();
    if (names && diagonal_m > kNamed_m && things.size() <= kMostNames)
      view.Name(thing.outline, thing.name, kSmallFont, colours::kThing);
  }
}

void DrawAxis(MapView& view, const DoorPlan& door) {
  view.Line(layers::kAxis, {door.map_from_door() * Vector2d(-2.5, 0), door.map_from_door() * Vector2d(2, 0)});
}

void DrawTruth(MapView& view, const RunRecord& record) {
  std::vector<Vector2d> path;
  for (const auto& truth : record.truth) path.push_back(PositionOf(truth));
  view.Line(layers::kTruth, path);
}

void DrawBelief(MapView& view, const RunRecord& record) {
  std::vector<Vector2d> stretch;
  for (const pose_t& pose : record.poses) {
    const Vector2d at = PositionOf(pose);
    if (!stretch.empty() && (at - stretch.back()).norm() > kJump_m) {
      view.Line(layers::kBelief, stretch);
      view.Arrow(layers::kCorrection, stretch.back(), at, kArrowHead_px);
      stretch.clear();
    }
    stretch.push_back(at);
  }
  view.Line(layers::kBelief, stretch);
}

void DrawEllipses(MapView& view, const RunRecord& record) {
  constexpr double kEvery_m = 0.4;
  const auto draw = [&](const pose_t& pose) {
    view.Area(layers::kSigma, EllipseOutline(PositionOf(pose), CovarianceOf(pose), 2));
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

void DrawLooks(MapView& view, const RunRecord& record, const DoorPlan& door) {
  int number = 0;
  for (const LookSpan& look : LooksOf(record)) {
    ++number;
    const std::int64_t exposure = look.correction.utime_exposure;
    const auto from = TruthAt(record, exposure != 0 ? exposure : look.begin_utime);
    if (!from) continue;
    const double half = door.opening_width_m / 2;
    const double y = look.side == 1 ? half : look.side == 2 ? -half : 0;
    view.Line(layers::kSight, {from->translation(), door.map_from_door() * Vector2d(door.FrontX(), y)});
    view.Dot(layers::kLook, from->translation(), 9);
    view.Label(from->translation(), fmt::format("{}", number), kBoldFont, colours::kFix, 14);
  }
}

void DrawRobot(MapView& view, const Pose2& pose, const Vector2d& size_m) {
  view.Area(layers::kFootprint, FootprintOutline(pose, size_m));
  const double tip = size_m.x() / 2, arm = 0.12 * size_m.x();
  view.Area(layers::kFootprint,
            {pose * Vector2d(tip, 0), pose * Vector2d(tip - arm, arm), pose * Vector2d(tip - arm, -arm)});
}

/// Where the mission ended: a robot that stands there while the record goes on is not drawn later.
const world_truth_t& AtTheEnd(const RunRecord& record, const MissionSpan& span, double same_place_m) {
  const world_truth_t& last = record.truth.back();
  const world_truth_t* end = &last;
  for (auto truth = record.truth.rbegin(); truth != record.truth.rend(); ++truth)
    if (end = &*truth; truth->utime <= span.end_utime) break;
  return (PositionOf(*end) - PositionOf(last)).norm() < same_place_m ? *end : last;
}

void DrawRobots(MapView& view, const RunRecord& record, const Vector2d& size_m) {
  constexpr double kEvery_m = 1.5, kLeast_m = 0.5;
  if (!record.poses.empty()) {
    const pose_t& pose = record.poses.front();
    view.Area(layers::kFirstBelief, FootprintOutline({pose.x_m, pose.y_m, pose.yaw_rad}, size_m));
  }
  if (record.truth.empty()) return;
  const MissionSpan span = SpanOf(record);
  const auto draw = [&](const world_truth_t& truth) {
    DrawRobot(view, PoseOf(truth), size_m);
    const double t_s = std::max(0.0, Seconds(Duration(truth.utime - span.begin_utime)));
    view.Label(PoseOf(truth) * Vector2d(-size_m.x() / 2, -size_m.y() / 2), fmt::format("{:.0f} s", t_s),
               kSmallFont, colours::kTruth, 4);
  };
  const world_truth_t *drawn = &record.truth.front(), *last = &AtTheEnd(record, span, kLeast_m);
  draw(*drawn);
  for (const world_truth_t& truth : record.truth) {
    if ((PositionOf(truth) - PositionOf(*drawn)).norm() < kEvery_m) continue;
    if ((PositionOf(truth) - PositionOf(*last)).norm() < kLeast_m) continue;
    drawn = &truth;
    draw(*drawn);
  }
  draw(*last);
}

void DrawContacts(MapView& view, const RunRecord& record) {
  int contacts = 0;
  for (const world_truth_t& truth : record.truth) {
    if (truth.contacts <= contacts) continue;
    contacts = truth.contacts;
    view.Cross(layers::kContact, PositionOf(truth), 16);
    view.Label(PositionOf(truth), "contact", kSmallFont, colours::kBad, 22);
  }
}

}  // namespace priamos::cli
