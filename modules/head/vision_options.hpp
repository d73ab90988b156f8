#pragma once

#include "head/core/camera/head_model.hpp"
#include "head/core/edges/edge_segments.hpp"
#include "head/core/landmark/landmark_fix.hpp"
#include "head/head_config.hpp"

namespace priamos::head {

/// What the configuration and the head's calibration mean for the search of landmarks and edges.
LandmarkFixOptions FinderOptions(const VisionConfig& vision, const HeadModel& head);
EdgeOperator::Options EdgeOptions(const VisionConfig& vision);

}  // namespace priamos::head
