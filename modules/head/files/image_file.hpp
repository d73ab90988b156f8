#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "common/frame_store.hpp"

namespace priamos::head {

/// Image files of one scene or one camera.
struct ImageFiles {
  std::vector<cv::Mat> grey;  ///< CV_8UC1, in the order of the files
  std::string note;  ///< a sentence for a person, where images of more than 8 bits were scaled; or empty
};

/// Reads image files (PNG, JPEG, TIFF, PGM, PPM, BMP) as grey values. Every image of the project is read
/// here. Images of 10 to 16 bits get one scale for all (ScaleToBytes). Throws ConfigError with one sentence
/// that names the file for one that cannot be read as a whole and undamaged, for one that is smaller than
/// `smallest_px` in either direction, and for one that would be enormous.
ImageFiles ReadImageFiles(const std::vector<std::string>& paths, int smallest_px);

/// The same of one image for calibration, which needs at least 64 by 64 pixels. Adds the note, if any, to
/// `notes`, as a line.
GreyImage ReadImage(const std::string& path, std::string& notes);

}  // namespace priamos::head
