#pragma once

#include "head/core/camera/head_model.hpp"
#include "head/core/look/look_evaluator.hpp"
#include "head/head_config.hpp"

namespace priamos::head {

/// What the configuration and the head's calibration mean for the search of landmarks and edges, and for a
/// whole look.
LandmarkFixOptions FinderOptions(const VisionConfig& vision, const HeadModel& head);
EdgeOperator::Options EdgeOptions(const VisionConfig& vision);
LookOptions EvaluatorOptions(const HeadConfig& config, const HeadModel& head);

}  // namespace priamos::head
