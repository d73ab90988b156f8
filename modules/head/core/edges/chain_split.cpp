#include "head/core/edges/chain_split.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>

namespace priamos::head {
namespace {

/// Least squares line through pixels, as `across = a + b * along` in the axis of the line's main extent.
class RunningFit {
 public:
  RunningFit(const GradientMap& gradients, ChainPixel origin, bool steep)
      : origin_(origin),
        steep_(steep),
        magnitude_(gradients.magnitude(0)),
        stride_(gradients.width()),
        side_(steep ? 1 : gradients.width()) {}

  void Add(ChainPixel p) {
    const float t = Along(p), s = Across(p) + PeakOffset(p);
    n_ += 1;
    st_ += t;
    ss_ += s;
    stt_ += t * t;
    sts_ += t * s;
    sss_ += s * s;
  }
  void Solve() {
    const float det = n_ * stt_ - st_ * st_;
    b_ = det > 0 ? (n_ * sts_ - st_ * ss_) / det : 0;
    a_ = (ss_ - b_ * st_) / n_;
    cos_ = 1 / std::sqrt(1 + b_ * b_);
  }
  float MeanSquare() const {
    const float sum = sss_ - 2 * (a_ * ss_ + b_ * sts_) + a_ * a_ * n_ + 2 * a_ * b_ * st_ + b_ * b_ * stt_;
    return std::max(0.0F, sum / n_) * cos_ * cos_;
  }
  float Distance(ChainPixel p) const { return std::abs(Across(p) - a_ - b_ * Along(p)) * cos_; }
  RoughLine Line(ChainPixel first, ChainPixel last) const {
    RoughLine line;
    Foot(first, line.x1, line.y1);
    Foot(last, line.x2, line.y2);
    return line;
  }

 private:
  float Along(ChainPixel p) const { return steep_ ? p.y - origin_.y : p.x - origin_.x; }
  float Across(ChainPixel p) const { return steep_ ? p.x - origin_.x : p.y - origin_.y; }
  /// From the pixel to the peak of the parabola through the gradients across the line.
  float PeakOffset(ChainPixel p) const {
    const unsigned short* const at = magnitude_ + std::ptrdiff_t(p.y) * stride_ + p.x;
    const int before = at[-side_], after = at[side_];
    const int bend = 2 * *at - before - after;
    return bend <= 0 ? 0 : std::clamp(0.5F * float(after - before) / float(bend), -0.7F, 0.7F);
  }
  void Foot(ChainPixel p, double& x, double& y) const {
    const float t = Along(p), s = a_ + b_ * t;
    x = origin_.x + (steep_ ? s : t);
    y = origin_.y + (steep_ ? t : s);
  }

  ChainPixel origin_;
  bool steep_;
  const unsigned short* magnitude_;
  int stride_, side_;
  float n_ = 0, st_ = 0, ss_ = 0, stt_ = 0, sts_ = 0, sss_ = 0;
  float a_ = 0, b_ = 0, cos_ = 1;
};

bool IsSteep(std::span<const ChainPixel> pixels) {
  return std::abs(pixels.back().y - pixels.front().y) >= std::abs(pixels.back().x - pixels.front().x);
}

/// Length of the straight piece at the front of `chain`, 0 if there is none.
int Grow(const GradientMap& gradients, std::span<const ChainPixel> chain,
         const ChainSplitter::Options& options, RoughLine& line) {
  const int m = options.min_pixels, n = static_cast<int>(chain.size());
  const auto start = chain.first(m);
  RunningFit fit(gradients, chain.front(), IsSteep(start));
  for (const ChainPixel p : start) fit.Add(p);
  fit.Solve();
  if (fit.MeanSquare() > options.begin_rms_px * options.begin_rms_px) return 0;
  int last = m - 1, strays = 0, unsolved = 0;
  for (int i = m; i < n && strays < options.max_strays; ++i) {
    if (fit.Distance(chain[i]) > options.max_distance_px) {
      ++strays;
      continue;
    }
    strays = 0;
    last = i;
    if (i % 2 != 0) continue;  // neighbours were smoothed together: every other one is as good
    fit.Add(chain[i]);
    // Early the fit moves much with each pixel, later little.
    if (++unsolved * 4 > last) {
      fit.Solve();
      unsolved = 0;
    }
  }
  fit.Solve();
  line = fit.Line(chain.front(), chain[last]);
  return last + 1;
}

}  // namespace

void ChainSplitter::Split(const GradientMap& gradients, const EdgeChains& chains, const Options& options,
                          std::vector<RoughLine>& lines) const {
  lines.clear();
  for (int c = 0; c < chains.size(); ++c) {
    std::span<const ChainPixel> rest(chains.pixels.data() + chains.begins[c],
                                     chains.pixels.data() + chains.begins[c + 1]);
    while (static_cast<int>(rest.size()) >= options.min_pixels) {
      RoughLine line;
      const int length = Grow(gradients, rest, options, line);
      if (length > 0) lines.push_back(line);
      rest = rest.subspan(length > 0 ? length : 3);
    }
  }
}

}  // namespace priamos::head
