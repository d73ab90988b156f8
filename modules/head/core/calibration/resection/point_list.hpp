#pragma once

#include <string>
#include <vector>

#include "common/outcome.hpp"
#include "head/core/calibration/resection/dlt.hpp"

namespace priamos::head {

/// Reads lines of five numbers `X Y Z u v`: a point of space [m] and its pixel. Separated by blanks, commas
/// or semicolons; empty lines and what follows a `#` do not count. A line that is something else, a number
/// that is not finite, and the same point twice are refused with the line's number.
Outcome<std::vector<PointPair>> ParsePointList(const std::string& text);

}  // namespace priamos::head
