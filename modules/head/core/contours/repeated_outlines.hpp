#pragma once

#include <span>
#include <vector>

#include "head/core/contours/polygon_search.hpp"

namespace priamos::head {

/// One outline for each place. Both borders of a thin line, or pieces of one broken side, give many outlines
/// whose corners lie beside each other: the one whose sides had to be changed least is kept.
std::vector<Polygon> WithoutRepeated(std::span<const Polygon> polygons, std::span<const Corner> corners);

}  // namespace priamos::head
