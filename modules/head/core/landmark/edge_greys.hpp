#pragma once

#include <optional>
#include <span>
#include <vector>

#include "head/core/landmark/edge_match.hpp"
#include "head/core/landmark/landmark.hpp"

namespace priamos::head {

/// What looks showed of LandmarkEdge::grey_ratio of one edge, and how far the next look's may be beside it.
struct EdgeGrey {
  double ratio = 0, sigma = 0;
};

/// Of every edge of a model; nullopt: no look has shown the edge. Empty: nothing is known.
using EdgeGreys = std::vector<std::optional<EdgeGrey>>;

/// How fast looks change what is known, and how well it can be known; natural logarithms.
struct EdgeGreyOptions {
  double first_sigma = 0.35;  ///< of an edge that one look has shown
  double least_sigma = 0.15;  ///< of one that looks agree about: the viewer moves, and with it what is behind
  double weight = 0.5;        ///< of a new look
  double contradiction = 3;   ///< sigmas beyond which what was known is forgotten
  double max_disagreement = 0.7;  ///< of the cameras of one look: more, and it does not count
};

/// What is known after a look that found the landmark with these matches. Each edge follows by its weight,
/// and is as sure as looks agreed; a contradiction is believed instead of what was known. Of movable edges
/// nothing is kept: they may be before something else in the next look.
EdgeGreys Learned(EdgeGreys known, const LandmarkModel& model, std::span<const EdgeMatch> matches,
                  const EdgeGreyOptions& options = {});

/// The model with what is known instead of what its sender told.
LandmarkModel WithGreys(LandmarkModel model, const EdgeGreys& known);

}  // namespace priamos::head
