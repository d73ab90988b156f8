#pragma once

#include <Eigen/Core>

namespace priamos {

/// Size of an image [px]; by default that of KASTOR's cameras by their data sheet.
struct ImageSize {
  int width = 768, height = 576;

  /// Where the data sheet puts the principal point: the middle of the image, (0, 0) being the centre of the
  /// top left pixel.
  Eigen::Vector2d Centre() const { return {(width - 1) / 2.0, (height - 1) / 2.0}; }
};

}  // namespace priamos
