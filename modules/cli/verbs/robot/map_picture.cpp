#include "cli/verbs/robot/map_picture.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/report/report_plan_view.hpp"
#include "common/drawing/legend.hpp"
#include "common/learned/wall_gaps.hpp"

namespace priamos::cli {
namespace {

using drawing::Box, drawing::Drawing, drawing::Layer, drawing::Symbol;
using Eigen::Vector2d;

constexpr double kMapWidth = 1200, kMapMargin = 36, kMapInner = kMapWidth - 2 * kMapMargin, kTallest = 1600;
constexpr double kAround_m = 0.5, kPoint_px = 7;

constexpr Layer kLearned{"learned-wall", "wall (learned)", {.line = colours::kFix, .width = 5}};
constexpr Layer kLearnedSigma{"learned-sigma",
                              "2 sigma of its place",
                              {.line = colours::kFix, .width = 1, .fill = colours::kFix, .opacity = 0.15},
                              Symbol::kArea};
constexpr Layer kGap{"gap", "gap between learned walls", {.line = colours::kBelief, .width = 3, .dash = 8}};
constexpr Layer kDoorOpen{"door-open", "door seen open", {.line = colours::kFix, .width = 3, .dash = 4}};
constexpr Layer kDoorShut{"door-shut", "door seen closed or ajar", {.line = colours::kBelief, .width = 7}};
constexpr Layer kSeen{"seen-thing",
                      "thing that the head saw",
                      {.line = colours::kThing, .width = 2, .fill = colours::kThing, .opacity = 0.25},
                      Symbol::kArea};
constexpr Layer kEdge{"seen-edge", "edge that the head saw", {.fill = colours::kThing}, Symbol::kDot};
constexpr Layer kPoint{
    "learned-point", "inner corner or edge (learned)", {.line = colours::kFix, .width = 3}, Symbol::kCross};
constexpr Layer kCorner{"corner", "corner of learned walls", {.fill = colours::kFix}, Symbol::kDot};

Extent ExtentOfBoth(const GroundPlan& plan, const LearnedWalls& learned) {
  Extent extent = ExtentOf(plan);
  if (plan.walls.empty() && !learned.walls.empty())
    extent = {learned.walls.front().from(), learned.walls.front().from()};
  else if (plan.walls.empty() && !learned.points.empty())
    extent = {learned.points.front().at(), learned.points.front().at()};
  for (const LearnedWall& wall : learned.walls) {
    for (const Vector2d& end : {wall.from(), wall.to()}) {
      extent.low = extent.low.cwiseMin(end);
      extent.high = extent.high.cwiseMax(end);
    }
  }
  for (const LearnedPoint& point : learned.points) {
    extent.low = extent.low.cwiseMin(point.at());
    extent.high = extent.high.cwiseMax(point.at());
  }
  for (const LearnedDoor& door : learned.doors) {
    extent.low = extent.low.cwiseMin(Vector2d(door.x_m, door.y_m));
    extent.high = extent.high.cwiseMax(Vector2d(door.x_m, door.y_m));
  }
  for (const LearnedObject& object : learned.objects) {
    for (const Vector2d& corner : object.Footprint().Corners()) {
      extent.low = extent.low.cwiseMin(corner);
      extent.high = extent.high.cwiseMax(corner);
    }
  }
  const Vector2d around = Vector2d::Constant(kAround_m);
  return {extent.low - around, extent.high + around};
}

void DrawWall(MapView& view, const LearnedWall& wall) {
  const double half_m = wall.length_m / 2, from_m = 2 * wall.SigmaAt(-half_m),
               to_m = 2 * wall.SigmaAt(half_m);
  const auto at = [&](double along_m, double across_m) {
    return wall.map_from_wall() * Vector2d(along_m, across_m);
  };
  view.Area(kLearnedSigma, {at(-half_m, from_m), at(half_m, to_m), at(half_m, -to_m), at(-half_m, -from_m)});
  view.Line(kLearned, {wall.from(), wall.to()});
}

void DrawGap(MapView& view, const WallGap& gap) {
  const Pose2 map_from_gap{gap.x_m, gap.y_m, Radians(gap.yaw_deg)};
  view.Line(kGap,
            {map_from_gap * Vector2d(-gap.width_m / 2, 0), map_from_gap * Vector2d(gap.width_m / 2, 0)});
  view.Label(map_from_gap.translation(), fmt::format("{:.2f} m", gap.width_m), kSmallFont, colours::kBelief,
             14);
}

/// Across its opening; the name stands behind it.
void DrawDoor(MapView& view, const LearnedDoor& door, const GroundPlan& plan) {
  const Pose2 at = door.map_from_door();
  view.Line(door.state == "open" ? kDoorOpen : kDoorShut,
            {at * Vector2d(0, -door.width_m / 2), at * Vector2d(0, door.width_m / 2)});
  view.Label(at * Vector2d(0.3, 0), NameOf(door, plan) + ": " + door.state, kSmallFont, colours::kInk, 14);
}

/// What it covers of the floor; an edge is a dot.
void DrawObject(MapView& view, const LearnedObject& object) {
  const Rectangle footprint = object.Footprint();
  if (object.kind == "edge") return view.Dot(kEdge, footprint.map_from_centre.translation(), 6);
  const auto corners = footprint.Corners();
  view.Area(kSeen, {corners.begin(), corners.end()});
  view.Label(footprint.map_from_centre.translation(),
             fmt::format("{}, {:.1f} m high", SizeOf(object), object.top_m), kSmallFont, colours::kThing, 14);
}

}  // namespace

Drawing DrawMap(const GroundPlan& plan, const LearnedWalls& learned) {
  const Extent extent = ExtentOfBoth(plan, learned);
  const double scale = std::min(kMapInner / extent.size().x(), kTallest / extent.size().y());
  const Box window{kMapMargin, kMapMargin, scale * extent.size().x(), scale * extent.size().y()};
  Drawing page(kMapWidth, 0, colours::kPaper);
  MapView view(page, window, extent.centre(), scale);
  DrawFloor(view, extent);
  DrawPlan(view, plan, true);
  for (const LearnedWall& wall : learned.walls) DrawWall(view, wall);
  for (const WallGap& gap : GapsOf(learned)) DrawGap(view, gap);
  for (const LearnedDoor& door : learned.doors) DrawDoor(view, door, plan);
  for (const LearnedObject& object : learned.objects) DrawObject(view, object);
  for (const WallCorner& corner : CornersOf(learned)) view.Dot(kCorner, {corner.x_m, corner.y_m}, 7);
  for (const LearnedPoint& point : learned.points) view.Cross(kPoint, point.at(), kPoint_px);
  view.SetLabels();
  const double top = window.bottom() + kMapMargin;
  page.SetHeight(top + drawing::WriteLegend(page, kMapMargin, top, kMapInner, {kBodyFont, colours::kInk}) +
                 kMapMargin);
  return page;
}

}  // namespace priamos::cli
