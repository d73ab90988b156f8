#pragma once

#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

#include "head/core/doors/door_detection.hpp"
#include "head/core/doors/image_doors.hpp"
#include "head/core/edges/edge_segments.hpp"
#include "head/see/see_options.hpp"

namespace priamos::head {

/// How the first camera stands, as told or as found in the images.
struct SeenStand {
  CameraStand stand{};
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of tilt and roll [rad^2]
  bool is_estimated = false;                             ///< tilt and roll were found
  double height_sigma_m = 0;
  std::string height_from{};  ///< what told the height; empty: the person
};

/// Doors in one image or a stereo pair, in a frame on the floor (OnTheFloor). `views` refer to `cameras` and
/// `edges`.
struct SeenDoors {
  std::vector<CameraModel> cameras;
  std::vector<EdgeImage> edges;
  std::vector<CameraView> views;
  std::vector<DetectedDoor> doors;  ///< of a pair
  std::vector<ImageDoor> in_image;  ///< of one image
  SeenStand stand;
  std::string why_not;  ///< why tilt and roll are not known; then no doors were looked for
};

/// Whether `options` ask for doors.
bool WantsDoors(const SeeOptions& options);

/// Doors in one image or a stereo pair. How the cameras stand is what SeeOptions::stand tells; what it leaves
/// out is found in the images (SeeOptions::doors), or is 0. Throws std::runtime_error for another number of
/// cameras or a stand that is none.
SeenDoors FindDoors(const SeeOptions& options, std::span<const cv::Mat> greys,
                    const std::vector<CameraModel>& cameras);

}  // namespace priamos::head
