#pragma once

#include <string>
#include <vector>

#include "head/core/calibrated_setup.hpp"
#include "head/core/calibration/outcome.hpp"

namespace priamos::head {

/// The calibrated setups as OpenCV FileStorage YAML, readable by people and by OpenCV alone.
std::string ToYaml(const std::vector<CalibratedSetup>& setups);

/// The way back. Refuses text that is no such table, or holds numbers no camera can have.
Outcome<std::vector<CalibratedSetup>> FromYaml(const std::string& text);

}  // namespace priamos::head
