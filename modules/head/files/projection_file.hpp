#pragma once

#include <string>

#include "head/core/camera/camera_model.hpp"

namespace priamos::head {

/// A camera of rectified photographs, from a YAML file as ROS's camera_calibration and OpenCV write it:
/// `projection_matrix` (3x4, base frame = the left camera's optical frame [m]), `image_width` and
/// `image_height`. Throws std::runtime_error naming the file, the key, what was expected and what was there;
/// also if the image has another size, or is not rectified (distortion is not zero).
CameraModel LoadProjection(const std::string& file, int image_width, int image_height);

}  // namespace priamos::head
