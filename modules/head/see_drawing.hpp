#pragma once

#include <opencv2/core/mat.hpp>
#include <span>

#include "head/core/contour_graph.hpp"
#include "head/core/edge_segment.hpp"
#include "head/core/edge_stereo.hpp"

namespace priamos::head {

/// The image, dimmed, with its edges (upright ones green, level ones blue, others orange), corners (red) and
/// parallelograms (filled).
cv::Mat DrawContours(const cv::Mat& grey, const EdgeImage& edges, const ContourGraph& contours);

/// The images side by side. What was matched has the same colour in all of them, from red (near) over yellow
/// and green to blue (far); matches along the epipolar lines, whose distance nobody knows, are white; other
/// edges are thin and grey.
cv::Mat DrawMatches(std::span<const cv::Mat> greys, std::span<const CameraView> views,
                    std::span<const StereoMatch> matches);

}  // namespace priamos::head
