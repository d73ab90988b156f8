#pragma once

#include <vector>

#include "common/learned/learned_walls.hpp"

namespace priamos::planner {

/// A piece of a line that is wall: from, to along it [m], and the wall as it was told.
struct WallSpan {
  double from_m = 0, to_m = 0;
  LearnedWall wall;
};

/// The walls that pieces of one line are, in their order along it; each has the newest of its pieces as its
/// `wall`. Pieces that were heard one after the other are one wall when next to nothing is between them;
/// those that were heard at different times are off along the line by what the reckoning lost in between, and
/// have to overlap. For the same reason the end that was heard last counts: the union of what was heard at
/// several times would close every opening beside it.
std::vector<WallSpan> JoinedSpans(const std::vector<WallSpan>& pieces);

}  // namespace priamos::planner
