#pragma once

#include <optional>
#include <string>

#include "cli/terminal/text_table.hpp"
#include "common/ground_plan.hpp"
#include "common/learned/learned_walls.hpp"

namespace priamos::cli {

/// The plan (dim), the learned walls (green) and the doors that were seen in braille, the longer side of the
/// map as wide as the screen.
std::string MapDots(const GroundPlan& plan, const LearnedWalls& learned, ScreenSize size, bool colour);

/// A row per learned wall, and one per gap between them. `now_s`: since 1970, for how long ago it was seen.
std::string MapTable(const LearnedWalls& learned, double now_s, std::optional<ScreenSize> size);

/// A row per door that was seen, by its name on the plan; likewise.
std::string DoorTable(const GroundPlan& plan, const LearnedWalls& learned, double now_s,
                      std::optional<ScreenSize> size);

}  // namespace priamos::cli
