#pragma once

#include <optional>
#include <vector>

#include "head/core/landmark/landmark.hpp"

namespace priamos::head {

/// Where two edges of a skeleton meet, each by one of its ends.
struct Meeting {
  bool a_at_from = false, b_at_from = false;  ///< the edges meet at LandmarkEdge::from; false: at `to`
};

/// Whether two edges end in the same corner: nearer to each other than `reach_m` (on the radio a coordinate
/// is a multiple of 2 mm, and a model has its tolerance) and not along one line.
std::optional<Meeting> MeetingOf(const LandmarkEdge& a, const LandmarkEdge& b, double reach_m = 0.01);

/// Two neighbours in a skeleton and their corner.
struct LandmarkCorner {
  int a = 0, b = 0;  ///< indices in LandmarkModel::edges, a < b
  Meeting meeting;
};

/// All corners of a model. They are attributes of its edges (paper, section 6.1) that follow from its
/// geometry and need not be sent.
std::vector<LandmarkCorner> CornersOf(const LandmarkModel& model);

}  // namespace priamos::head
