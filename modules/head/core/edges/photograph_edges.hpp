#pragma once

#include <opencv2/core/mat.hpp>

#include "head/core/edges/edge_segments.hpp"
#include "head/core/edges/scale_edges.hpp"

namespace priamos::head {

/// The edges of a photograph (CV_8UC1) of which nobody knows how sharp it is: one that shows nearly all of
/// its edges also at half its size is soft, and is seen over scales.
BlurredEdges EdgesOfPhotograph(const cv::Mat& grey, const EdgeOperator::Options& options);

}  // namespace priamos::head
