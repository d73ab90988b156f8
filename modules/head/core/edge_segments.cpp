#include "head/core/edge_segments.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace priamos::head {
namespace {

/// Sobel sum (of the smoothed image) that a step of one grey value gives.
constexpr double kSobelPerGrey = 2.3;

double Extent(const RoughLine& line) {
  return std::max(std::abs(line.x2 - line.x1), std::abs(line.y2 - line.y1));
}

}  // namespace

void EdgeOperator::Extract(const cv::Mat& image, EdgeImage& out) {
  if (image.type() != CV_8UC1 || std::min(image.cols, image.rows) < 32 ||
      std::max(image.cols, image.rows) > 16384) {
    throw std::invalid_argument("the edge operator needs a grey image of 32x32 to 16384x16384 pixels");
  }
  gradients_.Compute(image);
  ChainTracer::Options trace;
  trace.link_threshold =
      std::max(options_.min_contrast * kSobelPerGrey, options_.noise_factor * gradients_.GradientNoise());
  trace.seed_threshold = 1.5 * trace.link_threshold;
  trace.min_pixels = options_.split.min_pixels;
  tracer_.Trace(gradients_, trace, chains_);
  splitter_.Split(chains_, options_.split, rough_);

  out.width = image.cols, out.height = image.rows;
  out.noise_sigma = gradients_.noise_sigma();
  out.mean_grey = gradients_.mean_grey(), out.saturated_share = gradients_.saturated_share();
  out.segments.clear(), out.points.clear();
  refiner_.SetImage(image, gradients_.noise_sigma());
  EdgeRefiner::Options refit = options_.refit;
  refit.min_contrast = options_.min_contrast, refit.min_length_px = options_.min_length_px;
  // The longest first: they run on over their own broken pieces, which need not be looked at any more.
  std::stable_sort(rough_.begin(), rough_.end(),
                   [](const RoughLine& a, const RoughLine& b) { return Extent(a) > Extent(b); });
  owner_.create(image.size(), CV_16UC1);
  owner_.setTo(0);
  for (const RoughLine& line : rough_) {
    if (IsOwned(line, out) || !refiner_.Refine(line, refit, out)) continue;
    const EdgeSegment& found = out.segments.back();
    if (IsOwned({found.begin.x(), found.begin.y(), found.end.x(), found.end.y()}, out)) {
      out.points.resize(found.first_point);
      out.segments.pop_back();
    } else {
      Own(found, static_cast<int>(out.segments.size()));
    }
  }
  if (options_.fuse) FuseSegments(options_.fusion, out);
}

void EdgeOperator::Own(const EdgeSegment& segment, int id) {
  if (id > std::numeric_limits<unsigned short>::max()) return;  // then some broken edges stay double
  const Eigen::Vector2d way = segment.end - segment.begin;
  const bool steep = std::abs(way.y()) >= std::abs(way.x());
  const int n = static_cast<int>(way.cwiseAbs().maxCoeff());
  const Eigen::Vector2d step = way / std::max(n, 1);
  for (int i = 0; i <= n; ++i) {
    const Eigen::Vector2d at = segment.begin + i * step;
    const int x = static_cast<int>(at.x() + 0.5), y = static_cast<int>(at.y() + 0.5);
    for (int k = -1; k <= 1; ++k) {
      const int u = steep ? x + k : x, v = steep ? y : y + k;
      if (u >= 0 && v >= 0 && u < owner_.cols && v < owner_.rows)
        owner_.at<unsigned short>(v, u) = static_cast<unsigned short>(id);
    }
  }
}

/// True if nearly all of `line` runs on one segment of the same contrast sign.
bool EdgeOperator::IsOwned(const RoughLine& line, const EdgeImage& out) const {
  constexpr int kSamples = 5;
  int n_owned = 0, owner = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double f = (i + 0.5) / kSamples;
    const int x = static_cast<int>(line.x1 + f * (line.x2 - line.x1) + 0.5);
    const int y = static_cast<int>(line.y1 + f * (line.y2 - line.y1) + 0.5);
    if (x < 0 || y < 0 || x >= owner_.cols || y >= owner_.rows) continue;
    const int id = owner_.at<unsigned short>(y, x);
    if (id == 0) continue;
    n_owned += owner == 0 || owner == id;
    owner = id;
  }
  if (n_owned < kSamples - 1) return false;
  const Eigen::Vector2d way(line.x2 - line.x1, line.y2 - line.y1);
  return out.segments[owner - 1].direction().dot(way) > 0.9 * way.norm();
}

}  // namespace priamos::head
