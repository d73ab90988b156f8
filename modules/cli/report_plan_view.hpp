#pragma once

#include <Eigen/Core>
#include <vector>

#include "cli/report_canvas.hpp"
#include "cli/report_record.hpp"
#include "common/geometry.hpp"
#include "common/ground_plan.hpp"

/// What a run looks like from above, drawn into a View of the map.
namespace priamos::cli {

namespace colours {
inline constexpr Colour kPaper{0xffffff}, kFloor{0xf7f5f0}, kGrid{0xe7e3da}, kWall{0x3b4550},
    kFrame{0xa9713c};
inline constexpr Colour kInk{0x22282e}, kFaint{0x7b8590}, kTruth{0x1f62c4}, kBelief{0xe8741c}, kFix{0x12915a};
inline constexpr Colour kBad{0xc0322b};
}  // namespace colours

/// The part of the map that a plan covers.
struct Extent {
  Eigen::Vector2d low{0, 0}, high{10, 5};
  Eigen::Vector2d centre() const { return (low + high) / 2; }
  Eigen::Vector2d size() const { return high - low; }
};
Extent ExtentOf(const GroundPlan& plan);

Eigen::Vector2d PositionOf(const pose_t& pose);
Eigen::Vector2d PositionOf(const world_truth_t& truth);
/// Of the position alone.
Eigen::Matrix2d CovarianceOf(const pose_t& pose);
std::vector<Eigen::Vector2d> FootprintOutline(const Pose2& map_from_base);

void DrawFloor(View& view, const Extent& extent);
/// Walls, and the doors' frames with their rebates.
void DrawWalls(View& view, const GroundPlan& plan);
void DrawDoorName(View& view, const DoorPlan& door);
void DrawAxis(View& view, const DoorPlan& door);
void DrawTruth(View& view, const RunRecord& record);
/// The believed path; where a fix moved the belief there is an arrow instead.
void DrawBelief(View& view, const RunRecord& record, double width);
/// Ellipses of 2 sigma, one every 40 cm and on both sides of every jump.
void DrawEllipses(View& view, const RunRecord& record);
/// Where the robot stood when it looked, and what it looked at.
void DrawLooks(View& view, const RunRecord& record, const DoorPlan& door);
void DrawRobot(View& view, const Pose2& map_from_base, Colour colour, double opacity);
/// At the start (also where it believed to be), in the door, and at the end.
void DrawRobots(View& view, const RunRecord& record, const Pose2& map_from_door);

}  // namespace priamos::cli
