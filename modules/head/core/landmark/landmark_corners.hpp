#pragma once

#include <optional>

#include "head/core/landmark/landmark.hpp"

namespace priamos::head {

/// Where two edges of a skeleton meet, each by one of its ends.
struct Meeting {
  bool a_at_from = false, b_at_from = false;  ///< the edges meet at LandmarkEdge::from; false: at `to`
};

/// The corner in which two edges end, an attribute of both (paper, section 6.1) that follows from the model's
/// geometry and need not be sent; nullopt when they do not. Ends in one corner are nearer to each other than
/// `reach_m` (on the radio a coordinate is a multiple of 2 mm, and a model has its tolerance) and not along
/// one line.
std::optional<Meeting> MeetingOf(const LandmarkEdge& a, const LandmarkEdge& b, double reach_m = 0.01);

}  // namespace priamos::head
