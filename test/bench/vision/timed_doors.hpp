#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "head/core/doors/door_detection.hpp"
#include "head/core/edges/edge_segments.hpp"

namespace priamos::bench {

/// Doors in a stereo pair; its CPU time, edges included, is added to `seconds`.
std::vector<head::DetectedDoor> DetectTimed(const std::array<cv::Mat, 2>& images,
                                            const std::array<head::CameraModel, 2>& cameras,
                                            head::EdgeOperator& edge_operator, double& seconds);

}  // namespace priamos::bench
