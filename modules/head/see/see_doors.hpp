#pragma once

#include <nlohmann/json_fwd.hpp>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "head/core/doors/door_detection.hpp"
#include "head/core/stand/camera_stand.hpp"
#include "head/see/see_page.hpp"

namespace priamos::head {

/// How a camera stands: height [m], tilt [deg, down is positive] and roll [deg, right side down is positive];
/// tilt and roll may be left out. Throws std::runtime_error unless these are one to three numbers: 0.1 to 10
/// m, and up to 90 degrees to either side.
CameraStand StandFrom(const std::vector<double>& stand);

/// The images side by side with their edges (thin) and the doors: uprights and lintel, numbered from 1.
SeePage DrawDoors(std::span<const cv::Mat> greys, std::span<const CameraView> views,
                  std::span<const DetectedDoor> doors);

/// Place [m, deg], size, log odds and standard deviations of each door, in the base frame.
nlohmann::ordered_json DoorsToJson(std::span<const DetectedDoor> doors);

}  // namespace priamos::head
