#pragma once

#include <string>
#include <vector>

#include "common/image_size.hpp"
#include "head/core/camera/camera_model.hpp"

namespace priamos::head {

/// What the images are that belong to a file of a camera.
struct CameraFileOptions {
  ImageSize size;              ///< of the images
  bool are_rectified = false;  ///< the images were rectified since, by the file's projection matrix
};

/// The cameras of `files`, for `n` images in their order: a file for each, or one that holds all of them.
/// Read are, by their content and not by their names:
///
/// - ROS: camera_info as camera_calibration writes it and as a message is printed (YAML).
/// - OpenCV: FileStorage as YAML, XML or JSON, with or without its first line, with camera_matrix and
///   distortion_coefficients (also cameraMatrix and distCoeffs, M1 and D1).
/// - ViSP: vpXmlParserCamera, the model with distortion if there is one; the camera of a tracker's
/// configuration.
/// - PRIAMOS: what `priamos calibrate` writes, from files (JSON, also of several cameras) or of a head (the
/// table:
///   the head at rest, with its first zoom and focus).
///
/// Lengths are metres, image coordinates pixels: u right, v down, (0, 0) the centre of the top left pixel, as
/// in OpenCV, ROS and ViSP. The base frame is the optical frame of the first camera; where there are
/// projection matrices, the one they share. A file with intrinsics alone puts its camera there. Images are as
/// the camera took them unless CameraFileOptions says otherwise; then the distortion is undone. A file with a
/// projection matrix and no camera matrix belongs to rectified images.
///
/// Throws ConfigError "FILE:LINE: KEY: expected ..., got ..." for what cannot be read or is another kind of
/// camera (fish-eye), and where the images have another size.
std::vector<CameraModel> LoadCameras(const std::vector<std::string>& files, std::size_t n,
                                     const CameraFileOptions& options);

}  // namespace priamos::head
