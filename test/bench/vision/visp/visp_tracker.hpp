#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

namespace priamos::bench {

/// One camera of ViSP's tracker: a picture without distortion, and where the model is believed to be.
struct VispView {
  cv::Mat straight;
  double focal_px = 0;
  Eigen::Vector2d centre_px{0, 0};
  Eigen::Isometry3d camera_from_model = Eigen::Isometry3d::Identity();
};

struct VispResult {
  bool ok = false;                                                      ///< the tracker itself says so
  Eigen::Isometry3d camera_from_model = Eigen::Isometry3d::Identity();  ///< of the first camera
  double seconds = 0;                                                   ///< tracking alone, CPU
};

/// Lets ViSP's model-based edge tracker find the lines of a model from the believed pose on. C++17, as ViSP's
/// headers demand.
VispResult TrackWithVisp(const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>& lines,
                         const std::vector<VispView>& views);

}  // namespace priamos::bench
