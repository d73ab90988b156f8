#pragma once

#include <opencv2/core/mat.hpp>
#include <span>

#include "head/core/contours/contour_graph.hpp"
#include "head/core/edges/edge_segment.hpp"
#include "head/core/stereo/edge_stereo.hpp"
#include "head/see/see_page.hpp"

namespace priamos::head {

/// The image with its edges (upright, level and other ones), corners and parallelograms.
SeePage DrawContours(const cv::Mat& grey, const EdgeImage& edges, const ContourGraph& contours);

/// The images side by side. What was matched has the same colour in all of them, by its distance from red
/// (near) to blue (far); matches along the epipolar lines, whose distance nobody knows, are white; other
/// edges are thin and grey.
SeePage DrawMatches(std::span<const cv::Mat> greys, std::span<const CameraView> views,
                    std::span<const StereoMatch> matches);

}  // namespace priamos::head
