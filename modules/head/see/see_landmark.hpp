#pragma once

#include <nlohmann/json_fwd.hpp>
#include <opencv2/core/mat.hpp>
#include <span>

#include "head/core/bodies/free_model_fix.hpp"
#include "head/see/see_page.hpp"

namespace priamos::head {

/// The first image: what the model predicts at `believed` (thin, white), its visible edges where it
/// was found (magenta, only if it was), image edges that were taken for it (green) and all others (grey).
SeePage DrawLandmark(const cv::Mat& grey, std::span<const CameraView> views, const Polyhedron& body,
                     const Eigen::Isometry3d& believed, const FreeModelFix& fix);

/// Verdict, and if it was found pose, standard deviations and matches.
nlohmann::ordered_json LandmarkToJson(std::span<const CameraView> views, const FreeModelFix& fix);

/// Pose of x, y, z [m], roll, pitch, yaw [deg] about fixed axes, in the frame that the cameras share. Throws
/// std::runtime_error unless these are six finite numbers.
Eigen::Isometry3d PoseFromSix(const std::vector<double>& numbers);
std::array<double, 6> SixFromPose(const Eigen::Isometry3d& pose);

}  // namespace priamos::head
