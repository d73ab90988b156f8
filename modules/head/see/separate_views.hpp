#pragma once

#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <vector>

#include "head/core/camera/camera_model.hpp"

namespace priamos::head {

/// From one place nothing has a distance, and an image that is given twice tells no more than once, while it
/// would count twice. Two cameras never agree in every pixel.
///
/// Throws ConfigError naming `files` when two of `cameras` stand at one place: a file was given twice, or
/// does not say where its camera stands.
void RefuseOnePlace(const std::vector<std::string>& files, const std::vector<CameraModel>& cameras);

/// Throws ConfigError naming the two of `files` that hold the same image; `greys` are their images in the
/// same order, of one moment and of a camera each.
void RefuseSameImage(std::span<const std::string> files, std::span<const cv::Mat> greys);

}  // namespace priamos::head
