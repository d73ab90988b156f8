#include "head/core/edges/edge_segments.hpp"

#include <algorithm>
#include <stdexcept>

namespace priamos::head {
namespace {

/// Sobel sum (of the smoothed image) that a step of one grey value gives.
constexpr double kSobelPerGrey = 2.3;

/// The settings for an image of this mean: all contrasts of a dark one are weaker.
EdgeOperator::Options Exposed(const EdgeOperator::Options& usual, double mean_grey) {
  EdgeOperator::Options options = usual;
  if (mean_grey < usual.usual_grey)
    options.min_contrast = std::max(std::min(kWeakestEdge, usual.min_contrast),
                                    usual.min_contrast * mean_grey / usual.usual_grey);
  return options;
}

/// Numbers of `lines`, the longest first.
void SortByExtent(const std::vector<RoughLine>& lines, std::vector<std::pair<float, int>>& order) {
  order.clear();
  for (const RoughLine& line : lines) {
    const double extent = std::max(std::abs(line.x2 - line.x1), std::abs(line.y2 - line.y1));
    order.emplace_back(-float(extent), int(order.size()));
  }
  std::sort(order.begin(), order.end());
}

ChainTracer::Options TraceOptions(const EdgeOperator::Options& options, double gradient_noise) {
  ChainTracer::Options trace;
  trace.link_threshold =
      std::max(options.min_contrast * kSobelPerGrey, options.noise_factor * gradient_noise);
  trace.seed_threshold = 1.5 * trace.link_threshold;
  trace.min_pixels = options.split.min_pixels;
  return trace;
}

EdgeRefiner::Options RefitOptions(const EdgeOperator::Options& options) {
  EdgeRefiner::Options refit = options.refit;
  refit.min_contrast = options.min_contrast;
  refit.min_length_px = options.min_length_px;
  return refit;
}

}  // namespace

void EdgeOperator::Extract(const cv::Mat& image, EdgeImage& out) {
  if (image.type() != CV_8UC1 || std::min(image.cols, image.rows) < 32 ||
      std::max(image.cols, image.rows) > 16384) {
    throw std::invalid_argument("the edge operator needs a grey image of 32x32 to 16384x16384 pixels");
  }
  gradients_.Compute(image);
  const Options options = Exposed(options_, gradients_.mean_grey());
  tracer_.Trace(gradients_, TraceOptions(options, gradients_.GradientNoise()), chains_);
  splitter_.Split(gradients_, chains_, options_.split, rough_);

  out.width = image.cols;
  out.height = image.rows;
  out.noise_sigma = gradients_.noise_sigma();
  out.mean_grey = gradients_.mean_grey();
  out.saturated_share = gradients_.saturated_share();
  out.segments.clear();
  out.points.clear();
  refiner_.SetImage(image, gradients_.noise_sigma());
  const EdgeRefiner::Options refit = RefitOptions(options);
  // The longest first: they run on over their own broken pieces, which need not be looked at any more.
  SortByExtent(rough_, order_);
  found_.Clear(image.cols, image.rows);
  for (const auto& [extent, i] : order_) {
    const RoughLine& line = rough_[i];
    if (found_.Covers(line, out.segments) || !refiner_.Refine(line, refit, out)) continue;
    const EdgeSegment& segment = out.segments.back();
    const RoughLine refined{segment.begin.x(), segment.begin.y(), segment.end.x(), segment.end.y()};
    if (found_.Covers(refined, out.segments)) {
      out.points.resize(segment.first_point);
      out.segments.pop_back();
    } else {
      found_.Draw(segment, static_cast<int>(out.segments.size()) - 1);
    }
  }
  if (options_.fuse) FuseSegments(options_.fusion, out);
}

}  // namespace priamos::head
