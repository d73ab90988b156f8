#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/geometry.hpp"
#include "common/image_size.hpp"
#include "head/core/calibration/resection/view_fit.hpp"

namespace priamos::head {

/// What is known beforehand about camera and view, and when a labelling is believed.
struct LabellerOptions {
  double min_focal_px = 650, max_focal_px = 2000;
  Eigen::Vector2d image_centre_px = ImageSize{}.Centre();
  double centre_sigma_px = 20;        ///< how far the principal point may be from it
  double k1_sigma = 0.1;              ///< sigma of the radial distortion at one focal length from the centre
  double max_roll_rad = Radians(50);  ///< angle of the object's z axis to the image's upward direction
  int max_hidden = 6;                 ///< discs that may be missing
  double max_rms_px = 0.4;            ///< RMS residual of a labelling that is accepted
};

/// Disc `disc` of the object is detection `detection`.
struct DiscLabel {
  int disc, detection;
  friend bool operator==(const DiscLabel&, const DiscLabel&) = default;
};

/// Which disc is which, ordered by disc, and the camera that shows it.
struct Labelling {
  std::vector<DiscLabel> labels;
  PinholeView view;  ///< in the frame of the object
  double rms_px = 0;
};

}  // namespace priamos::head
