#include "head/core/edges/guided_edges.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace priamos::head {
namespace {

constexpr double kSharpest_px =
    1.8;  ///< blur from which on an image is reduced: the kernels see that much well
constexpr EdgeRefiner::Options kFaint{
    .min_length_px = 8, .min_contrast = 4, .min_significance = 6, .max_spread_px = 3.5};

constexpr int kFewestPoints = 3;

/// `segment` of the reduced image in pixels of the whole one. Pixels are counted from their centres.
Eigen::Vector2d Enlarged(const Eigen::Vector2d& at, double factor) {
  return factor * at + Eigen::Vector2d::Constant((factor - 1) / 2);
}

Eigen::Vector2d Reduced(const Eigen::Vector2d& at, double factor) {
  return (at - Eigen::Vector2d::Constant((factor - 1) / 2)) / factor;
}

}  // namespace

GuidedEdges::GuidedEdges(const cv::Mat& image, double noise_sigma, double blur_px) : reduced_(image) {
  for (; blur_px / factor_ > kSharpest_px && std::min(reduced_.cols, reduced_.rows) >= 64; factor_ *= 2) {
    cv::Mat half;
    const cv::Size size(reduced_.cols / 2, reduced_.rows / 2);
    cv::resize(reduced_({0, 0, 2 * size.width, 2 * size.height}), half, size, 0, 0, cv::INTER_AREA);
    reduced_ = half;
  }
  refiner_.SetImage(reduced_, noise_sigma / factor_);
}

bool GuidedEdges::Measure(const Eigen::Vector2d& from, const Eigen::Vector2d& to, EdgeImage& out) {
  const Eigen::Vector2d p = Reduced(from, factor_), q = Reduced(to, factor_);
  found_.segments.clear();
  found_.points.clear();
  if (!refiner_.Refine({p.x(), p.y(), q.x(), q.y()}, kFaint, found_) &&
      !refiner_.Refine({q.x(), q.y(), p.x(), p.y()}, kFaint, found_))
    return false;
  EdgeSegment segment = found_.segments.front();
  segment.begin = Enlarged(segment.begin, factor_);
  segment.end = Enlarged(segment.end, factor_);
  segment.centre = Enlarged(segment.centre, factor_);
  segment.sigma_normal_px *= factor_;
  segment.first_point = static_cast<int>(out.points.size());
  const Eigen::Vector2d direction = (to - from).normalized();
  for (const EdgePoint& point : found_.points) {
    const Eigen::Vector2d at = Enlarged(point.at, factor_);
    const double along = direction.dot(at - from);
    if (along >= 0 && along <= (to - from).norm())
      out.points.push_back({at, factor_ * point.sigma_normal_px});
  }
  segment.n_points = static_cast<int>(out.points.size()) - segment.first_point;
  if (segment.n_points >= kFewestPoints)
    out.segments.push_back(segment);
  else
    out.points.resize(segment.first_point);
  return segment.n_points >= kFewestPoints;
}

}  // namespace priamos::head
