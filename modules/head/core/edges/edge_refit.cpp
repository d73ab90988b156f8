#include "head/core/edges/edge_refit.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"
#include "common/square.hpp"

namespace priamos::head {
namespace {

/// Sharp edges that run along the pixel grid are sampled too coarsely for a narrow kernel: so much between
/// the two widths means nothing.
constexpr double kToleratedGap_px = 0.05;
constexpr double kNear_px = 0.8;  ///< distance from the edge below which its ends are searched
/// So near one linear step is exact: for wide kernels, and for narrow ones.
constexpr double kSettled_px[] = {0.8, 0.5};
constexpr double kLost_px = 5;
constexpr double kPixelsBeyond = 1;     ///< an edge reaches about so far beyond the pixels that were linked
constexpr double kTypicalSpread = 1.4;  ///< wide kernel and lens together [px]

AxisLine ToAxis(const RoughLine& rough, int& first, int& last) {
  const double dx = rough.x2 - rough.x1, dy = rough.y2 - rough.y1;
  AxisLine line;
  line.steep = std::abs(dy) >= std::abs(dx);
  line.sign = line.steep ? (dy < 0 ? 1 : -1) : (dx > 0 ? 1 : -1);
  const double t1 = line.steep ? rough.y1 : rough.x1, t2 = line.steep ? rough.y2 : rough.x2;
  const double s1 = line.steep ? rough.x1 : rough.y1, s2 = line.steep ? rough.x2 : rough.y2;
  line.origin = (t1 + t2) / 2;
  line.offset = (s1 + s2) / 2;
  line.slope = t1 == t2 ? 0 : (s2 - s1) / (t2 - t1);
  first = static_cast<int>(std::lround(std::min(t1, t2)));
  last = static_cast<int>(std::lround(std::max(t1, t2)));
  return line;
}

/// Moves `line` to pass `step` beside itself at row `centroid`, turned by `turn`.
void Move(AxisLine& line, double centroid, double step, double turn) {
  line.offset = line.Across(centroid) + step;
  line.origin = centroid;
  line.slope += turn;
}

}  // namespace

void EdgeRefiner::SetImage(const cv::Mat& image, double noise_sigma) {
  blocks_.SetImage(image);
  noise_sigma_ = std::max(noise_sigma, 0.3);  // rounding to whole grey values is noise, too
}

bool EdgeRefiner::IsClear(const AxisLine& line, const Options& options) const {
  const EdgeSums& total = blocks_.total();
  const double strength = total.strength / total.rows;
  const double noise = std::sqrt(line.wide->first_gain) * noise_sigma_;
  return strength * line.Stretch() * kTypicalSpread * std::sqrt(2 * kPi) >= options.min_contrast &&
         strength * std::sqrt(total.rows) >= options.min_significance * noise &&
         total.sharpness[0] * Square(options.max_spread_px) >= total.strength;
}

/// The wide kernels' fit, or the narrow ones' if they contradict it.
bool EdgeRefiner::Choose(EdgeOffset& fit) {
  EdgeOffset narrow;
  const bool has_narrow = fitter_.Solve(KernelWidth::kNarrow, 1, narrow);
  if (!fitter_.Solve(KernelWidth::kWide, 3, fit)) return false;
  fitter_.AddVariance(fit);
  if (!has_narrow) return true;
  const double gap = narrow.offset - fit.offset - fit.slope * (narrow.centroid - fit.centroid);
  const double turn = narrow.slope - fit.slope;
  // The same rows seen through narrower kernels are noisier in this proportion.
  const double noisier = 1 + fitter_.noise(KernelWidth::kNarrow) / fitter_.noise(KernelWidth::kWide) *
                                 Square(fit.kappa / narrow.kappa);
  const double tolerated_turn = 2 * kToleratedGap_px / (blocks_.last() - blocks_.first());
  if (Square(std::max(0.0, std::abs(gap) - kToleratedGap_px)) > 9 * noisier * fit.variance_offset ||
      Square(std::max(0.0, std::abs(turn) - tolerated_turn)) > 9 * noisier * fit.variance_slope) {
    if (!fitter_.Solve(KernelWidth::kNarrow, 3, fit)) return false;
    fitter_.AddVariance(fit);
  }
  return true;
}

bool EdgeRefiner::Refine(const RoughLine& rough, const Options& options, EdgeImage& out) {
  constexpr int kRounds = 4;
  int first = 0, last = 0;
  AxisLine line = ToAxis(rough, first, last);
  if ((last - first) * line.Stretch() < options.min_length_px - kPixelsBeyond) return false;
  blocks_.ChooseSize(last - first);
  EdgeOffset fit;
  for (int round = 0; round < kRounds; ++round) {
    line.ChooseKernels();
    blocks_.Measure(line, first, last);
    fitter_.Load(blocks_, line, noise_sigma_);
    if (!fitter_.Solve(KernelWidth::kWide, 1, fit)) return false;
    const double move = fit.Move((last - first) / 2.0);
    if (move > kLost_px) return false;
    if (move < kNear_px) {
      if (!IsClear(line, options) || !blocks_.FindEnds(line)) return false;
      const double extent = blocks_.last() - blocks_.first();
      if (extent * line.Stretch() < options.min_length_px) return false;
      fitter_.Load(blocks_, line, noise_sigma_);
      if (!Choose(fit)) return false;
      if (fit.Move(extent / 2) < kSettled_px[int(fit.width)]) {
        Append(line, fit, options, out);
        return true;
      }
      first = static_cast<int>(std::ceil(blocks_.first()));
      last = static_cast<int>(blocks_.last());
    }
    Move(line, fit.centroid, fit.offset, fit.slope);
    if (std::abs(line.slope) > 1.3) return false;
  }
  return false;
}

void EdgeRefiner::Append(const AxisLine& measured, const EdgeOffset& fit, const Options& options,
                         EdgeImage& out) const {
  AxisLine line = measured;
  Move(line, fit.centroid, fit.offset, fit.slope);
  const double cosine = 1 / line.Stretch();
  const bool ascending = line.steep ? line.sign < 0 : line.sign > 0;  // bright side on the right hand
  const double begin = ascending ? blocks_.first() : blocks_.last();
  const double end = ascending ? blocks_.last() : blocks_.first();
  EdgeSegment segment;
  segment.begin = line.Point(begin, line.Across(begin));
  segment.end = line.Point(end, line.Across(end));
  segment.centre = line.Point(fit.centroid, line.Across(fit.centroid));
  segment.sigma_normal_px = std::sqrt(fit.variance_offset * Square(cosine) + Square(options.floor_px));
  segment.sigma_angle_rad =
      std::sqrt(fit.variance_slope * Square(Square(cosine)) + Square(options.floor_px / segment.length_px()));
  const EdgeSums& total = blocks_.total();
  segment.grey_left = (line.sign > 0 ? total.low : total.high) / total.rows;
  segment.grey_right = (line.sign > 0 ? total.high : total.low) / total.rows;
  segment.first_point = static_cast<int>(out.points.size());
  AppendPoints(measured, fit, options, out);
  segment.n_points = static_cast<int>(out.points.size()) - segment.first_point;
  out.segments.push_back(segment);
}

void EdgeRefiner::AppendPoints(const AxisLine& measured, const EdgeOffset& fit, const Options& options,
                               EdgeImage& out) const {
  const double noise = fitter_.noise(fit.width) / Square(fit.kappa * measured.Stretch());
  const auto all = blocks_.all();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (fitter_.weight(i) <= 0) continue;
    const double variance = noise * all[i].rows * Square(all[i].inverse);
    out.points.push_back({measured.Point(all[i].along, measured.Across(all[i].along) + fitter_.shift(i)),
                          std::sqrt(variance + Square(options.floor_px))});
  }
}

}  // namespace priamos::head
