#pragma once

#include <string>

#include "head/core/camera/head_model.hpp"

namespace priamos::head {

/// Reads a calibration table. Throws ConfigError, with the command that makes one, if it is missing or
/// damaged.
HeadModel LoadHeadModel(const std::string& path);

/// Replaces the table at `path` as a whole: an interrupted write leaves the old one. Throws
/// std::runtime_error.
void SaveHeadModel(const std::string& path, const HeadModel& model);

}  // namespace priamos::head
