#pragma once

#include <string>
#include <vector>

#include "head/core/calibrated_setup.hpp"

namespace priamos::head {

/// Reads a calibration table. Throws ConfigError, with the command that makes one, if it is missing or
/// damaged.
std::vector<CalibratedSetup> LoadSetups(const std::string& path);

/// Replaces the table at `path` as a whole: an interrupted write leaves the old one. Throws
/// std::runtime_error.
void SaveSetups(const std::string& path, const std::vector<CalibratedSetup>& setups);

}  // namespace priamos::head
