#pragma once

#include <optional>
#include <string>

#include "cli/terminal/text_table.hpp"
#include "common/ground_plan.hpp"
#include "common/learned/learned_walls.hpp"

namespace priamos::cli {

/// The plan (dim), the learned walls and points (green), the doors that were seen and the things that the
/// head saw (red) in braille, the longer side of the map as wide as the screen.
std::string MapDots(const GroundPlan& plan, const LearnedWalls& learned, ScreenSize size, bool colour);

/// A row per learned wall, and one per gap between them. `now_s`: since 1970, for how long ago it was seen.
std::string MapTable(const LearnedWalls& learned, double now_s, std::optional<ScreenSize> size);

/// A row per inner corner or edge that was heard; likewise.
std::string PointTable(const LearnedWalls& learned, double now_s, std::optional<ScreenSize> size);

/// A row per door that was seen, by its name on the plan; likewise.
std::string DoorTable(const GroundPlan& plan, const LearnedWalls& learned, double now_s,
                      std::optional<ScreenSize> size);

/// A row per thing that the head saw; likewise.
std::string ObjectTable(const LearnedWalls& learned, double now_s, std::optional<ScreenSize> size);

}  // namespace priamos::cli
