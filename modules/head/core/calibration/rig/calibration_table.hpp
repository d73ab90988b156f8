#pragma once

#include <string>

#include "common/outcome.hpp"
#include "head/core/camera/head_model.hpp"

namespace priamos::head {

/// The calibration table as a text that a person can read (OpenCV FileStorage YAML): mechanics, lens tables
/// over zoom and focus, and how well the whole is placed in the base frame. Reading it back gives the same
/// numbers. Cameras that were not calibrated have no nodes.
std::string ToYaml(const HeadModel& model);

/// Reads such a text. A damaged, truncated or foreign one is refused with one sentence; it never throws.
Outcome<HeadModel> FromYaml(const std::string& yaml);

}  // namespace priamos::head
