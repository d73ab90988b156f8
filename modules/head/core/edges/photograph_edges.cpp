#include "head/core/edges/photograph_edges.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace priamos::head {
namespace {

constexpr int kSmallest_px = 64;   ///< a smaller one has no half that could be compared
constexpr double kBlurred = 0.75;  ///< a sharp photograph shows at half its size less than this of its edges

double LengthOf(const EdgeImage& image) {
  double length_px = 0;
  for (const EdgeSegment& segment : image.segments) length_px += segment.length_px();
  return length_px;
}

}  // namespace

BlurredEdges EdgesOfPhotograph(const cv::Mat& grey, const EdgeOperator::Options& options) {
  EdgeOperator edge_operator(options);
  EdgeImage edges, of_half;
  edge_operator.Extract(grey, edges);
  if (std::min(grey.cols, grey.rows) < kSmallest_px) return {std::move(edges), {}};
  cv::Mat half;
  cv::resize(grey, half, {}, 0.5, 0.5, cv::INTER_AREA);
  edge_operator.Extract(half, of_half);
  const double length_px = LengthOf(edges);
  if (length_px > 0 && 2 * LengthOf(of_half) <= kBlurred * length_px) return {std::move(edges), {}};
  BlurredEdges blurred;
  ScaleEdgeOperator(options).Extract(grey, blurred);
  return blurred;
}

}  // namespace priamos::head
