#include "head/core/edge_refit.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"

namespace priamos::head {
namespace {

constexpr double kMaxShiftPx = 1.5;  ///< an edge farther beside the line is another one
/// Sharp edges that run along the pixel grid are sampled too coarsely for a narrow kernel: so much between
/// the two widths means nothing.
constexpr double kToleratedGapPx = 0.05;
constexpr double kCornerPx = 0.2;   ///< how far a corner bends the edge that ends there
constexpr double kSettledPx = 0.5;  ///< so near the edge one linear step is exact
constexpr double kNearPx = 0.8;     ///< so near it is worth looking how far the edge goes
constexpr double kLostPx = 5;
constexpr double kPixelsBeyond = 1;     ///< an edge reaches about so far beyond the pixels that were linked
constexpr double kTypicalSpread = 1.4;  ///< wide kernel and lens together [px]

double Square(double x) {
  return x * x;
}

AxisLine ToAxis(const RoughLine& rough, int& first, int& last) {
  const double dx = rough.x2 - rough.x1, dy = rough.y2 - rough.y1;
  AxisLine line;
  line.steep = std::abs(dy) >= std::abs(dx);
  line.sign = line.steep ? (dy < 0 ? 1 : -1) : (dx > 0 ? 1 : -1);
  const double t1 = line.steep ? rough.y1 : rough.x1, t2 = line.steep ? rough.y2 : rough.x2;
  const double s1 = line.steep ? rough.x1 : rough.y1, s2 = line.steep ? rough.x2 : rough.y2;
  line.origin = (t1 + t2) / 2, line.offset = (s1 + s2) / 2;
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
  profile_.SetImage(image);
  noise_sigma_ = std::max(noise_sigma, 0.3);  // rounding to whole grey values is noise, too
}

void EdgeRefiner::MeasureBlocks(const AxisLine& line, int first, int last) {
  blocks_.clear();
  total_ = EdgeSums{};
  for (int t = first; t <= last; t += block_rows_) {
    blocks_.push_back(profile_.Sum(line, t, std::min(t + block_rows_ - 1, last)));
    total_.Add(blocks_.back());
  }
  SetLimits();
}

/// What MeasureBlocks found decides which blocks belong to the edge.
void EdgeRefiner::SetLimits() {
  mean_strength_ = total_.strength / float(total_.rows);
  farthest_ = float(kMaxShiftPx) * total_.sharpness[0] / total_.strength;
}

bool EdgeRefiner::IsEdge(const EdgeSums& b) const {
  return b.rows > 0 && b.strength > 0.5F * mean_strength_ * float(b.rows) &&
         std::abs(b.imbalance[0]) < farthest_ * b.strength;
}

/// Follows the edge beyond the measured blocks as far as it goes.
void EdgeRefiner::Extend(const AxisLine& line) {
  const int extent = profile_.Extent(line);
  const auto ahead = [&](const EdgeSums& last, int step) {
    const int next = static_cast<int>(std::lround(last.along + step * (last.rows + 1) / 2.0));
    const int far = next + step * (block_rows_ - 1);
    return next < 0 || next >= extent ? EdgeSums{}
                                      : profile_.Sum(line, std::min(next, far), std::max(next, far));
  };
  const auto room = [&] { return blocks_.size() + front_.size() < kMaxBlocks; };
  front_.clear();
  while (room() && IsEdge(blocks_.back())) blocks_.push_back(ahead(blocks_.back(), 1));
  EdgeSums first = blocks_.front();
  while (room() && IsEdge(first)) front_.push_back(first = ahead(first, -1));
  blocks_.insert(blocks_.begin(), front_.rbegin(), front_.rend());
}

/// Drops blocks without the edge from both ends; the ends lie where half the strength is lost.
void EdgeRefiner::Trim() {
  const float mean = mean_strength_;
  const auto part = [&](const EdgeSums& b) {  // rows of the edge inside a block beyond the end
    return std::clamp(b.strength / mean, 0.0F, float(b.rows));
  };
  double before = 0, after = 0;
  while (!blocks_.empty() && !IsEdge(blocks_.back())) after = part(blocks_.back()), blocks_.pop_back();
  std::size_t lost = 0;
  while (lost < blocks_.size() && !IsEdge(blocks_[lost])) before = part(blocks_[lost++]);
  blocks_.erase(blocks_.begin(), blocks_.begin() + lost);
  total_ = EdgeSums{};
  for (const EdgeSums& b : blocks_) total_.Add(b);
  if (blocks_.empty()) return;
  const auto whole = [&](const EdgeSums& b) {
    return std::clamp(b.strength / mean, 0.5F * float(b.rows), float(b.rows));
  };
  const EdgeSums &front = blocks_.front(), &back = blocks_.back();
  first_ = front.along + 0.5 * front.rows - whole(front) - before;
  last_ = back.along - 0.5 * back.rows + whole(back) + after;
}

/// Weighted least squares over the blocks; with more than one round, blocks that disagree lose weight.
bool EdgeRefiner::Solve(const AxisLine& line, KernelWidth width, int rounds, Fit& fit) {
  fit = Fit{};
  fit.width = width;
  if (blocks_.size() < 3 || total_.sharpness[int(width)] <= 0 || total_.strength <= 0) return false;
  // For a Gaussian edge this holds beside its centre, too.
  fit.kappa = total_.sharpness[int(width)] / total_.strength;
  if (width == KernelWidth::kWide) fit.kappa += Square(total_.imbalance[0] / total_.strength);
  const float per_imbalance = 1 / float(fit.kappa), farthest = kMaxShiftPx;
  shifts_ = (imbalances_[int(width)] * per_imbalance).max(-farthest).min(farthest);
  base_ = strengths_;
  // Corners disturb the ends: a loss worth taking unless a block's own noise is larger.
  const auto n = base_.size();
  const double block_noise = std::sqrt(line.kernels(width).second_gain * total_.rows / double(n)) *
                             noise_sigma_ * double(n) / (fit.kappa * total_.strength);
  if (n >= 8 && block_noise < kCornerPx) base_[0] = base_[n - 1] = 0;
  weights_ = base_;
  for (int round = 0; round < rounds; ++round) {
    if (round > 0 && !Reweight(line, fit)) return true;
    if (!FitLine(fit)) return false;
  }
  return true;
}

/// The blocks as arrays.
void EdgeRefiner::Collect() {
  const auto n = static_cast<Eigen::Index>(blocks_.size());
  along_.resize(n), rows_.resize(n), strengths_.resize(n), imbalances_[0].resize(n), imbalances_[1].resize(n);
  const float gap = 0.25F * mean_strength_;
  for (Eigen::Index i = 0; i < n; ++i) {
    const EdgeSums& b = blocks_[i];
    along_[i] = b.along, rows_[i] = float(b.rows);
    strengths_[i] = b.strength > gap * rows_[i] ? b.strength : 0;
    for (int k = 0; k < 2; ++k) imbalances_[k][i] = b.imbalance[k] * b.inverse;
  }
}

bool EdgeRefiner::FitLine(Fit& fit) const {
  const float weight = weights_.sum();
  if (weight <= 0) return false;
  fit.centroid = (weights_ * along_).sum() / weight;
  const auto tau = along_ - float(fit.centroid);
  const float spread = (weights_ * tau.square()).sum();
  if (spread <= 0) return false;
  fit.step_offset = (weights_ * shifts_).sum() / weight;
  fit.step_slope = (weights_ * tau * shifts_).sum() / spread;
  return true;
}

/// False if no block is far off.
bool EdgeRefiner::Reweight(const AxisLine& line, const Fit& fit) {
  constexpr float kLimit = 2.5, kFloorPx = 0.03;
  const auto noise = float(Square(noise_sigma_) * line.kernels(fit.width).second_gain);
  const auto slope2 = (float(fit.kappa) * base_).square();
  const auto error =
      shifts_ - float(fit.step_offset) - float(fit.step_slope) * (along_ - float(fit.centroid));
  misfits_ = slope2 * error.square();
  allowed_ = kLimit * kLimit * (noise * rows_ + kFloorPx * kFloorPx * slope2);
  if ((misfits_ <= allowed_).all()) return false;
  weights_ = base_ * (allowed_ / misfits_.max(allowed_)).sqrt();
  return true;
}

/// From the pixel noise, enlarged where the blocks scatter more than that explains.
void EdgeRefiner::AddVariance(const AxisLine& line, Fit& fit) const {
  const auto noise = float(Square(noise_sigma_) * line.kernels(fit.width).second_gain);
  const auto kappa = float(fit.kappa);
  double w = 0, wtt = 0, v = 0, vtt = 0, chi2 = 0;
  int n = 0;
  for (Eigen::Index i = 0; i < weights_.size(); ++i) {
    if (weights_[i] <= 0) continue;
    const float tau = along_[i] - float(fit.centroid), share = weights_[i] * blocks_[i].inverse / kappa;
    const float variance = noise * rows_[i] * share * share;
    const float error = shifts_[i] - float(fit.step_offset) - float(fit.step_slope) * tau;
    w += weights_[i], wtt += weights_[i] * tau * tau, v += variance, vtt += variance * tau * tau;
    chi2 += Square(error * weights_[i]) / variance;
    ++n;
  }
  const double inflation = n > 4 ? std::clamp(chi2 / (n - 2), 1.0, 25.0) : 1.0;
  fit.variance_offset = inflation * v / Square(w);
  fit.variance_slope = inflation * vtt / Square(wtt);
}

bool EdgeRefiner::IsClear(const AxisLine& line, const Options& options) const {
  const double strength = total_.strength / total_.rows;
  const double noise = std::sqrt(line.wide->first_gain) * noise_sigma_;
  return strength * line.Stretch() * kTypicalSpread * std::sqrt(2 * kPi) >= options.min_contrast &&
         strength * std::sqrt(total_.rows) >= options.min_significance * noise &&
         total_.sharpness[0] * Square(options.max_spread_px) >= total_.strength;
}

/// The wide kernels' fit, or the narrow ones' if they contradict it.
bool EdgeRefiner::Choose(const AxisLine& line, Fit& fit) {
  Fit narrow;
  const bool has_narrow = Solve(line, KernelWidth::kNarrow, 1, narrow);
  if (!Solve(line, KernelWidth::kWide, 3, fit)) return false;
  AddVariance(line, fit);
  if (!has_narrow) return true;
  const double gap = narrow.step_offset - fit.step_offset - fit.step_slope * (narrow.centroid - fit.centroid);
  const double turn = narrow.step_slope - fit.step_slope;
  // The same rows seen through narrower kernels are noisier in this proportion.
  const double noisier =
      1 + line.narrow->second_gain / line.wide->second_gain * Square(fit.kappa / narrow.kappa);
  if (Square(std::max(0.0, std::abs(gap) - kToleratedGapPx)) > 9 * noisier * fit.variance_offset ||
      Square(std::max(0.0, std::abs(turn) - 2 * kToleratedGapPx / (last_ - first_))) >
          9 * noisier * fit.variance_slope) {
    if (!Solve(line, KernelWidth::kNarrow, 3, fit)) return false;
    AddVariance(line, fit);
  }
  return true;
}

bool EdgeRefiner::Refine(const RoughLine& rough, const Options& options, EdgeImage& out) {
  constexpr int kRounds = 4;
  int first = 0, last = 0;
  AxisLine line = ToAxis(rough, first, last);
  if ((last - first) * line.Stretch() < options.min_length_px - kPixelsBeyond) return false;
  block_rows_ = last - first < 24 ? 3 : last - first < 160 ? 4 : 8 + (last - first) / (kMaxBlocks / 2);
  Fit fit;
  for (int round = 0; round < kRounds; ++round) {
    line.ChooseKernels();
    MeasureBlocks(line, first, last);
    Collect();
    if (!Solve(line, KernelWidth::kWide, 1, fit)) return false;
    const double move = fit.Move((last - first) / 2.0);
    if (move > kLostPx) return false;
    if (move < kNearPx) {
      if (!IsClear(line, options)) return false;
      Extend(line);
      Trim();
      if (blocks_.empty() || (last_ - first_) * line.Stretch() < options.min_length_px) return false;
      Collect();
      if (!Choose(line, fit)) return false;
      first = static_cast<int>(std::ceil(first_)), last = static_cast<int>(last_);
      if (fit.Move((last_ - first_) / 2) < kSettledPx) {
        Append(line, fit, options, out);
        return true;
      }
    }
    Move(line, fit.centroid, fit.step_offset, fit.step_slope);
    if (std::abs(line.slope) > 1.3) return false;
  }
  return false;
}

void EdgeRefiner::Append(const AxisLine& measured, const Fit& fit, const Options& options,
                         EdgeImage& out) const {
  AxisLine line = measured;
  Move(line, fit.centroid, fit.step_offset, fit.step_slope);
  const double cosine = 1 / line.Stretch();
  const auto point = [&](double along, double across) -> Eigen::Vector2d {
    return line.steep ? Eigen::Vector2d(across, along) : Eigen::Vector2d(along, across);
  };
  const bool ascending = line.steep ? line.sign < 0 : line.sign > 0;  // bright side on the right hand
  const double begin = ascending ? first_ : last_, end = ascending ? last_ : first_;
  EdgeSegment segment;
  segment.begin = point(begin, line.Across(begin));
  segment.end = point(end, line.Across(end));
  segment.centre = point(fit.centroid, line.Across(fit.centroid));
  segment.sigma_normal_px = std::sqrt(fit.variance_offset * Square(cosine) + Square(options.floor_px));
  segment.sigma_angle_rad =
      std::sqrt(fit.variance_slope * Square(Square(cosine)) + Square(options.floor_px / segment.length_px()));
  segment.grey_left = (line.sign > 0 ? total_.low : total_.high) / total_.rows;
  segment.grey_right = (line.sign > 0 ? total_.high : total_.low) / total_.rows;
  segment.first_point = static_cast<int>(out.points.size());
  const double noise = noise_sigma_ * std::sqrt(measured.kernels(fit.width).second_gain);
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const EdgeSums& b = blocks_[i];
    if (weights_[Eigen::Index(i)] <= 0) continue;
    const double sigma = noise * std::sqrt(b.rows) / (fit.kappa * b.strength);
    out.points.push_back({point(b.along, measured.Across(b.along) + shifts_[Eigen::Index(i)]),
                          std::sqrt(Square(sigma * cosine) + Square(options.floor_px))});
  }
  segment.n_points = static_cast<int>(out.points.size()) - segment.first_point;
  out.segments.push_back(segment);
}

}  // namespace priamos::head
