#pragma once

#include <string>
#include <vector>

#include "head/core/calibrated_setup.hpp"
#include "head/core/calibration/outcome.hpp"

namespace priamos::head {

/// The calibration table as a text that a person can read (OpenCV FileStorage YAML). Reading it back gives
/// the same numbers.
std::string ToYaml(const std::vector<CalibratedSetup>& setups);

/// Reads such a text. A damaged, truncated or foreign one is refused with one sentence; it never throws.
Outcome<std::vector<CalibratedSetup>> FromYaml(const std::string& yaml);

}  // namespace priamos::head
