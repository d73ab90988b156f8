#pragma once

#include <opencv2/core/mat.hpp>
#include <span>

#include "head/see/see_findings.hpp"

namespace priamos::head {

/// Whether `options` ask for doors.
bool WantsDoors(const SeeOptions& options);

/// Doors in one image or a stereo pair. How the cameras stand is what SeeOptions::stand tells; what it leaves
/// out is found in the images (SeeOptions::doors), or is 0. Throws std::runtime_error for another number of
/// cameras or a stand that is none.
SeenDoors FindDoors(const SeeOptions& options, std::span<const cv::Mat> greys,
                    const std::vector<CameraModel>& cameras);

}  // namespace priamos::head
