#include "head/core/edges/scale_edges.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "head/core/edges/image_levels.hpp"

namespace priamos::head {
namespace {

constexpr double kLeastBlur_px = 0.9;   ///< pixels of a level: what is sharper belongs to the finer one
constexpr double kWidestBlur_px = 2.2;  ///< pixels of a level: what is softer is measured on a coarser one
constexpr double kChunk_px = 6;         ///< step in which a coarse edge is compared with finer ones
constexpr double kShortest_px = 8;      ///< shortest edge, in pixels of a coarse level

/// `segment` of the whole image in the pixels of a level.
EdgeSegment OnLevel(EdgeSegment segment, double factor) {
  segment.begin = ToLevel(segment.begin, factor);
  segment.end = ToLevel(segment.end, factor);
  return segment;
}

EdgeOperator::Options CoarseOptions(EdgeOperator::Options options) {
  options.min_length_px = std::min(options.min_length_px, kShortest_px);
  options.split.min_pixels = std::min(options.split.min_pixels, int(kShortest_px) - 1);
  return options;
}

}  // namespace

double BlurredEdges::MedianBlur() const {
  std::vector<std::pair<double, double>> of_length;
  double all_px = 0;
  for (std::size_t i = 0; i < blur_px.size(); ++i) {
    of_length.emplace_back(blur_px[i], edges.segments[i].length_px());
    all_px += of_length.back().second;
  }
  std::sort(of_length.begin(), of_length.end());
  double sharper_px = 0;
  for (const auto& [blur, length] : of_length)
    if ((sharper_px += length) >= all_px / 2) return blur;
  return 0;
}

ScaleEdgeOperator::ScaleEdgeOperator(const EdgeOperator::Options& options) : options_(options) {
  operators_.fill(EdgeOperator(CoarseOptions(options)));
  operators_[0] = EdgeOperator(options);
}

void ScaleEdgeOperator::Extract(const cv::Mat& image, BlurredEdges& out) {
  operators_[0].Extract(image, out.edges);
  images_[0] = image;
  meters_[0].SetImage(image);
  found_.Clear(image.cols, image.rows);
  for (int i = 0; i < int(out.edges.segments.size()); ++i) found_.Draw(out.edges.segments[i], i);
  int n_levels = 1;
  for (; n_levels < kLevels; ++n_levels) {
    if (!Halve(images_[n_levels - 1], images_[n_levels])) break;
    meters_[n_levels].SetImage(images_[n_levels]);
    AddLevel(n_levels, out.edges);
  }
  if (options_.fuse && n_levels > 1) FuseSegments(options_.fusion, out.edges);
  out.blur_px.clear();
  for (const EdgeSegment& s : out.edges.segments) out.blur_px.push_back(Blur(s, n_levels));
}

void ScaleEdgeOperator::AddLevel(int level, EdgeImage& out) {
  operators_[level].Extract(images_[level], coarse_);
  for (const EdgeSegment& segment : coarse_.segments) {
    if (meters_[level].Blur(segment) >= kLeastBlur_px) AddPieces(segment, std::exp2(level), out);
  }
}

/// Adds what is left of a coarse edge where finer ones run.
void ScaleEdgeOperator::AddPieces(const EdgeSegment& coarse, double factor, EdgeImage& out) {
  EdgeSegment whole = coarse;
  whole.begin = ToWhole(coarse.begin, factor);
  whole.end = ToWhole(coarse.end, factor);
  whole.centre = ToWhole(coarse.centre, factor);
  whole.sigma_normal_px *= factor;
  const int n = std::max(1, int(whole.length_px() / kChunk_px));
  const double step = whole.length_px() / n;
  const std::size_t first_new = out.segments.size();
  int begin = 0;
  for (int i = 0; i <= n; ++i) {
    if (i < n && !Runs(whole, i * step, (i + 1) * step, factor, out)) continue;
    if ((i - begin) * step >= options_.min_length_px) AddPiece(whole, begin * step, i * step, factor, out);
    begin = i + 1;
  }
  for (std::size_t i = first_new; i < out.segments.size(); ++i) found_.Draw(out.segments[i], int(i));
}

/// True if a finer edge of the same contrast runs near `whole` between two distances from its begin. Blur
/// moves an edge near corners, hence not on the very line only.
bool ScaleEdgeOperator::Runs(const EdgeSegment& whole, double from, double to, double factor,
                             const EdgeImage& finer) const {
  for (const double aside : {0.0, factor, -factor}) {
    const Eigen::Vector2d origin = whole.begin + aside * whole.normal();
    const Eigen::Vector2d a = origin + from * whole.direction(), b = origin + to * whole.direction();
    if (found_.Covers({.x1 = a.x(), .y1 = a.y(), .x2 = b.x(), .y2 = b.y()}, finer.segments)) return true;
  }
  return false;
}

/// Adds the piece of `whole` between two distances from its begin, with the points that lie there. The line
/// was fitted as a whole, so a piece keeps its centre and its standard deviations.
void ScaleEdgeOperator::AddPiece(const EdgeSegment& whole, double from, double to, double factor,
                                 EdgeImage& out) {
  EdgeSegment piece = whole;
  piece.begin = whole.begin + from * whole.direction();
  piece.end = whole.begin + to * whole.direction();
  piece.first_point = int(out.points.size());
  for (int i = 0; i < whole.n_points; ++i) {
    const EdgePoint& point = coarse_.points[whole.first_point + i];
    const Eigen::Vector2d at = ToWhole(point.at, factor);
    const double along = whole.direction().dot(at - whole.begin);
    if (along >= from && along <= to) out.points.push_back({at, factor * point.sigma_normal_px});
  }
  piece.n_points = int(out.points.size()) - piece.first_point;
  out.segments.push_back(piece);
}

/// Measured on the finest level on which the edge is not too soft.
double ScaleEdgeOperator::Blur(const EdgeSegment& segment, int n_levels) const {
  double blur = 0;
  for (int level = 0; level < n_levels; ++level) {
    const double factor = std::exp2(level);
    blur = meters_[level].Blur(OnLevel(segment, factor));
    if (blur <= kWidestBlur_px || level + 1 == n_levels) return factor * blur;
  }
  return blur;
}

}  // namespace priamos::head
