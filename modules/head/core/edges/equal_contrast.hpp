#pragma once

#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "head/core/edges/edge_segments.hpp"

namespace priamos::head {

/// How to look for edges in images of one scene, so that cameras that differ in exposure find the same ones:
/// as `usual` in the image of the largest contrast, weaker ones in flatter images (down to 3 grey values,
/// which tell no more).
std::vector<EdgeOperator::Options> ForOneScene(std::span<const cv::Mat> images,
                                               const EdgeOperator::Options& usual);

}  // namespace priamos::head
