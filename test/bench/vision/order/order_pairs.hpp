#pragma once

#include <array>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "head/core/camera/camera_model.hpp"
#include "test/bench/vision/vision_bench.hpp"

namespace priamos::bench {

/// Two images and their cameras, in the right order.
struct OrderPair {
  std::array<cv::Mat, 2> images;
  std::array<head::CameraModel, 2> cameras;
};

/// Rendered pairs of one kind of scene, one after the other.
void ForEachRendered(const VisionOptions& options, int n,
                     const std::function<void(const char* kind, const OrderPair&)>& visit);

/// Photographs: the chessboards of opencv-doc, calibrated and rectified by OpenCV; the aloe there; `--pair`.
std::vector<std::pair<std::string, OrderPair>> PhotographedPairs(const VisionOptions& options);

}  // namespace priamos::bench
