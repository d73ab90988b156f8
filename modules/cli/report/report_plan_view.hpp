#pragma once

#include <Eigen/Core>
#include <vector>

#include "cli/report/report_map_view.hpp"
#include "cli/report/report_record.hpp"
#include "cli/scenario/true_things.hpp"
#include "common/geometry.hpp"

/// Drawing of a run from above, in a view of the map.
namespace priamos::cli {

namespace colours {
inline constexpr drawing::Colour kPaper{0xffffff}, kFloor{0xf7f5f0}, kGrid{0xe0dbd0}, kWall{0x3b4550},
    kFrame{0xa9713c}, kThing{0x8a2be2};
inline constexpr drawing::Colour kInk{0x22282e}, kFaint{0x6b7580}, kTruth{0x1f62c4}, kBelief{0xe8741c},
    kFix{0x12915a}, kBad{0xc0322b}, kNoGo{0xd9780f};
}  // namespace colours

/// Every kind of thing in the picture, as it is drawn and as the legend explains it.
namespace layers {
using drawing::Layer, drawing::Symbol;
inline constexpr Layer kFloor{"floor", "", {.fill = colours::kFloor}};
inline constexpr Layer kGrid{"grid", "", {.line = colours::kGrid, .width = 1.5}};
inline constexpr Layer kText{"text", ""};
inline constexpr Layer kWall{"wall", "wall (plan)", {.fill = colours::kWall}, Symbol::kArea};
inline constexpr Layer kFrame{"door-frame", "door frame (plan)", {.fill = colours::kFrame}, Symbol::kArea};
inline constexpr Layer kCupboard{"cupboard",
                                 "cupboard (plan)",
                                 {.line = colours::kWall, .width = 2, .fill = colours::kWall, .opacity = 0.4},
                                 Symbol::kArea};
inline constexpr Layer kNoGo{
    "no-go",
    "no-go area (plan)",
    {.line = colours::kNoGo, .width = 2, .dash = 6, .fill = colours::kNoGo, .opacity = 0.15},
    Symbol::kArea};
inline constexpr Layer kThing{
    "truth-thing",
    "not in the plan: truth (world)",
    {.line = colours::kThing, .width = 2.5, .fill = colours::kThing, .opacity = 0.2},
    Symbol::kArea};
inline constexpr Layer kAxis{
    "door-axis", "axis of the door", {.line = colours::kFaint, .width = 1.5, .dash = 10}};
inline constexpr Layer kFootprint{
    "truth-footprint",
    "robot, true to scale",
    {.line = colours::kTruth, .width = 2, .fill = colours::kTruth, .opacity = 0.1},
    Symbol::kArea};
inline constexpr Layer kSwept{"truth-swept",
                              "floor it covered (at the door)",
                              {.fill = colours::kTruth, .opacity = 0.4},
                              Symbol::kArea};
inline constexpr Layer kFirstBelief{"belief-start",
                                    "where it believed to start",
                                    {.line = colours::kBelief, .width = 2.5, .dash = 8},
                                    Symbol::kArea};
inline constexpr Layer kSigma{
    "belief-sigma",
    "2 sigma of the belief",
    {.line = colours::kBelief, .width = 1.2, .fill = colours::kBelief, .opacity = 0.16},
    Symbol::kEllipse};
inline constexpr Layer kTruth{"truth-path", "true path (world)", {.line = colours::kTruth, .width = 5}};
inline constexpr Layer kBelief{"belief-path", "believed path", {.line = colours::kBelief, .width = 3}};
inline constexpr Layer kSight{
    "look", "look at a side of the door", {.line = colours::kFix, .width = 2.5, .dash = 9}};
inline constexpr Layer kLook{"look-place", "place of fix 1, 2 ...", {.fill = colours::kFix}, Symbol::kDot};
inline constexpr Layer kCorrection{
    "correction", "correction by a fix", {.line = colours::kFix, .width = 3}, Symbol::kArrow};
inline constexpr Layer kContact{"contact", "contact", {.line = colours::kBad, .width = 6}, Symbol::kCross};
}  // namespace layers

/// Text that is still read when the picture is as wide as a telephone: a third of 1200 px.
inline constexpr drawing::Font kBodyFont{30}, kBoldFont{30, true}, kSmallFont{25};

/// A part of the map.
struct Extent {
  Eigen::Vector2d low{0, 0}, high{10, 5};
  Eigen::Vector2d centre() const { return (low + high) / 2; }
  Eigen::Vector2d size() const { return high - low; }
};
/// What the walls of a plan reach over; an example where it has none.
Extent ExtentOf(const GroundPlan& plan);
/// What a picture of a run shows: the walls of the plan, or where it has none all true solids, and the true
/// path with some floor around it, as far as it leads to within a building's size of them.
Extent ExtentOfRun(const GroundPlan& plan, const std::vector<TrueThing>& things, const RunRecord& record);

Eigen::Vector2d PositionOf(const pose_t& pose);
Eigen::Vector2d PositionOf(const world_truth_t& truth);
/// Covariance of the position (x, y), map frame [m^2].
Eigen::Matrix2d CovarianceOf(const pose_t& pose);
/// Corners of the footprint of a robot of length and width `size_m`, map frame.
std::vector<Eigen::Vector2d> FootprintOutline(const Pose2& map_from_base, const Eigen::Vector2d& size_m);

/// The floor with a grid of 1 m.
void DrawFloor(MapView& view, const Extent& extent);
/// The planner's map: walls, frames of the doors with their rebates, cupboards.
void DrawPlan(MapView& view, const GroundPlan& plan, bool names);
/// True solids that the planner does not know; large ones are named.
void DrawThings(MapView& view, const std::vector<TrueThing>& things, bool names);
void DrawAxis(MapView& view, const DoorPlan& door);
void DrawTruth(MapView& view, const RunRecord& record);
/// The believed path; where a fix moved the belief there is an arrow instead.
void DrawBelief(MapView& view, const RunRecord& record);
/// Ellipses of 2 sigma, one every 40 cm and on both sides of every jump.
void DrawEllipses(MapView& view, const RunRecord& record);
/// Where the robot stood when it looked, and what it looked at.
void DrawLooks(MapView& view, const RunRecord& record, const DoorPlan& door);
void DrawRobot(MapView& view, const Pose2& map_from_base, const Eigen::Vector2d& size_m);
/// The true robot at the start, about every 1.5 m, and at the end, with the time since the order; and where
/// it believed to start.
void DrawRobots(MapView& view, const RunRecord& record, const Eigen::Vector2d& size_m);
/// Where the robot was when it touched something.
void DrawContacts(MapView& view, const RunRecord& record);

}  // namespace priamos::cli
