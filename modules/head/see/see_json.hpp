#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "head/core/contours/contour_graph.hpp"
#include "head/core/edges/edge_segment.hpp"
#include "head/core/stereo/edge_stereo.hpp"

namespace priamos::head {

/// Segments with sub-pixel ends, corners and outlines of one image; numbers in `corners` and `outlines` count
/// segments and corners from 0.
nlohmann::ordered_json EdgesToJson(const std::string& file, const EdgeImage& edges,
                                   const ContourGraph& contours);

/// Matches, by the segments' numbers in their images, with the edge of space [m] and its standard deviations.
nlohmann::ordered_json MatchesToJson(std::span<const CameraView> views, std::span<const StereoMatch> matches);

}  // namespace priamos::head
