#pragma once

#include <opencv2/core.hpp>

#include "common/random.hpp"

namespace priamos::world {

/// Side of every texture and picture [px].
inline constexpr int kTextureSide = 512;

/// Pictures that fill one face of a box: CV_32F albedo, first row at the top of the face.

/// A sheet with a white border, figures and lines of writing.
cv::Mat PosterPicture(Rng& rng);

/// A door leaf with handle and lock plate (at 1.05 m of 2 m) on `surface`.
cv::Mat LeafPicture(const cv::Mat& surface);

/// Two doors with a gap, handles and a plinth on `surface`.
cv::Mat CupboardPicture(const cv::Mat& surface);

}  // namespace priamos::world
