#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "head/core/bodies/free_model_fix.hpp"

namespace priamos::head {

/// What came of the images of one moment.
struct MomentReport {
  std::vector<std::string> images;
  FreeModelFix fix;
  std::string why_unread;  ///< why an image could not be read; empty if all were
  double time_ms = 0;      ///< from the file to the fix
  int n_lost = 0;          ///< moments since the body was seen last
};

/// A line for a person: where the body is and how well that is known, or why it was not found.
std::string MomentText(const MomentReport& report);

/// The same for programs; `views` as they were looked at.
nlohmann::ordered_json MomentToJson(const MomentReport& report, std::span<const CameraView> views);

}  // namespace priamos::head
