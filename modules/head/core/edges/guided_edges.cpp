#include "head/core/edges/guided_edges.hpp"

#include <algorithm>
#include <cmath>

#include "head/core/edges/image_levels.hpp"

namespace priamos::head {
namespace {

constexpr double kSharpest_px =
    1.8;  ///< blur from which on an image is reduced: the kernels see that much well
constexpr EdgeRefiner::Options kFaint{
    .min_length_px = 8, .min_contrast = 4, .min_significance = 6, .max_spread_px = 3.5};

constexpr int kFewestPoints = 3;

}  // namespace

GuidedEdges::GuidedEdges(const cv::Mat& image, double noise_sigma, double blur_px) : reduced_(image) {
  cv::Mat half;
  for (; blur_px / factor_ > kSharpest_px && Halve(reduced_, half); factor_ *= 2) {
    reduced_ = half;
    half = cv::Mat();  // not the one that reduced_ refers to
  }
  refiner_.SetImage(reduced_, noise_sigma / factor_);
}

bool GuidedEdges::Measure(const Eigen::Vector2d& from, const Eigen::Vector2d& to, EdgeImage& out) {
  const Eigen::Vector2d p = ToLevel(from, factor_), q = ToLevel(to, factor_);
  found_.segments.clear();
  found_.points.clear();
  if (!refiner_.Refine({p.x(), p.y(), q.x(), q.y()}, kFaint, found_) &&
      !refiner_.Refine({q.x(), q.y(), p.x(), p.y()}, kFaint, found_))
    return false;
  EdgeSegment segment = found_.segments.front();
  segment.begin = ToWhole(segment.begin, factor_);
  segment.end = ToWhole(segment.end, factor_);
  segment.centre = ToWhole(segment.centre, factor_);
  segment.sigma_normal_px *= factor_;
  segment.first_point = static_cast<int>(out.points.size());
  const Eigen::Vector2d direction = (to - from).normalized();
  for (const EdgePoint& point : found_.points) {
    const Eigen::Vector2d at = ToWhole(point.at, factor_);
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
