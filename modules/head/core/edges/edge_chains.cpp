#include "head/core/edges/edge_chains.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <opencv2/core/hal/intrin.hpp>
#include <utility>

namespace priamos::head {
namespace {

constexpr int kGrid = 8;  ///< seeds lie on every 8th row or column: a straight edge of 12 px crosses one
constexpr int kLanes = cv::v_int16x8::nlanes;

/// Calls `found(i)` for each of the `n` magnitudes from `at` that is at least `threshold`, larger than the
/// one `step` before and no smaller than the one `step` behind it; for some twice. `n` is at least kLanes.
template <class Found>
void ForEachPeak(const unsigned short* at, std::ptrdiff_t step, int n, double threshold, Found&& found) {
  const auto values = reinterpret_cast<const short*>(at);  // a magnitude is at most 2040
  const cv::v_int16x8 least = cv::v_setall_s16(static_cast<short>(threshold));
  for (int i = 0; i < n; i += kLanes) {
    const int first = std::min(i, n - kLanes);
    const short* const here = values + first;
    const cv::v_int16x8 value = cv::v_load(here);
    const cv::v_int16x8 peak =
        (value >= least) & (value > cv::v_load(here - step)) & (value >= cv::v_load(here + step));
    for (auto left = unsigned(cv::v_signmask(peak)); left != 0; left &= left - 1) {
      found(first + std::countr_zero(left));
    }
  }
}

}  // namespace

/// The direction of a walk, one of four, and its steps in memory and in x and y.
struct ChainTracer::Heading {
  int tx, ty;          ///< a step ahead: (+-1, 0) or (0, +-1)
  int ahead, side;     ///< steps in memory
  int side_x, side_y;  ///< a step to the side

  static Heading Of(int tx, int ty, int stride) {
    if (std::abs(ty) >= std::abs(tx)) return {0, ty > 0 ? 1 : -1, ty > 0 ? stride : -stride, 1, 1, 0};
    return {tx > 0 ? 1 : -1, 0, tx > 0 ? 1 : -1, stride, 0, 1};
  }
  bool Holds(int x, int y) const { return x * tx + y * ty >= std::abs(x * ty) + std::abs(y * tx); }
};

void ChainTracer::Trace(const GradientMap& gradients, const Options& options, EdgeChains& chains) {
  stride_ = gradients.width();
  visited_.assign(std::size_t(stride_) * gradients.height(), 0);
  CloseBorder(gradients.height());
  walk_.resize(visited_.size());
  chains.pixels.clear();
  chains.begins.assign(1, 0);
  for (int y = kGrid; y < gradients.height() - 2; y += kGrid) SeedRow(gradients, options, y, chains);
  SeedColumns(gradients, options, chains);
}

/// Marks the border as visited, so that no walk needs to check for the end of the image.
void ChainTracer::CloseBorder(int height) {
  const auto close = [&](std::size_t from, std::size_t n) { std::fill_n(visited_.begin() + from, n, 1); };
  close(0, stride_);
  close(std::size_t(height - 1) * stride_, stride_);
  for (int y = 1; y < height; ++y) close(std::size_t(y) * stride_ - 1, 2);
}

/// Steep edges: strongest in the row.
void ChainTracer::SeedRow(const GradientMap& gradients, const Options& options, int y, EdgeChains& chains) {
  constexpr int kMargin = 2;
  const short *const gx = gradients.gx(y) + kMargin, *const gy = gradients.gy(y) + kMargin;
  ForEachPeak(gradients.magnitude(y) + kMargin, 1, stride_ - 2 * kMargin, options.seed_threshold, [&](int i) {
    if (std::abs(gx[i]) >= std::abs(gy[i])) TraceFrom(gradients, options, i + kMargin, y, chains);
  });
}

/// Flat edges: strongest in the column.
void ChainTracer::SeedColumns(const GradientMap& gradients, const Options& options, EdgeChains& chains) {
  const int n = (stride_ - 3) / kGrid, step = (n + kLanes - 1) / kLanes * kLanes;
  // The columns side by side, so that neighbours in memory can be looked at together.
  columns_.assign(std::size_t(step) * gradients.height(), 0);
  for (int y = 0; y < gradients.height(); ++y) {
    const unsigned short* const row = gradients.magnitude(y) + kGrid;
    unsigned short* const out = columns_.data() + std::ptrdiff_t(y) * step;
    for (std::ptrdiff_t i = 0; i < n; ++i) out[i] = row[i * kGrid];
  }
  for (int y = 2; y < gradients.height() - 2; ++y) {
    const short *const gx = gradients.gx(y), *const gy = gradients.gy(y);
    const unsigned short* const row = columns_.data() + std::ptrdiff_t(y) * step;
    ForEachPeak(row, step, step, options.seed_threshold, [&](int i) {
      const int x = (i + 1) * kGrid;
      if (std::abs(gx[x]) < std::abs(gy[x])) TraceFrom(gradients, options, x, y, chains);
    });
  }
}

void ChainTracer::TraceFrom(const GradientMap& gradients, const Options& options, int x, int y,
                            EdgeChains& chains) {
  const int threshold = static_cast<int>(options.link_threshold);
  const ChainPixel seed{static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)};
  if (std::exchange(visited_[std::size_t(y) * stride_ + x], 1) != 0) return;
  ChainPixel* const begin = walk_.data();
  ChainPixel* const middle = Follow(gradients, threshold, seed, -1, begin);
  std::reverse(begin, middle);
  *middle = seed;
  const ChainPixel* const end = Follow(gradients, threshold, seed, 1, middle + 1);
  if (end - begin < options.min_pixels) return;
  chains.pixels.insert(chains.pixels.end(), static_cast<const ChainPixel*>(begin), end);
  chains.begins.push_back(static_cast<int>(chains.pixels.size()));
}

ChainPixel* ChainTracer::Follow(const GradientMap& gradients, int threshold, ChainPixel seed, int hand,
                                ChainPixel* out) {
  const short *const gx = gradients.gx(0), *const gy = gradients.gy(0);
  int at = seed.y * stride_ + seed.x;
  // The tangent (gy, -gx) has the bright side on the right; averaged over a few pixels, or noise would turn
  // the walk where the edge is diagonal.
  int tx = 4 * hand * gy[at], ty = -4 * hand * gx[at];
  while (true) {
    const Heading heading = Heading::Of(tx, ty, stride_);
    do {
      ChainPixel* const before = out;
      // Every other gradient is enough, and half as many reads from far memory.
      for (int i = 0; i < 2; ++i) {
        if (!Step(gradients, threshold, heading, at, seed)) return out;
        *out++ = seed;
      }
      const int ahead_x = hand * gy[at], ahead_y = -hand * gx[at];
      if (ahead_x * tx + ahead_y * ty <= 0) return before;  // an edge of other contrast
      tx += 2 * ahead_x - tx / 2;
      ty += 2 * ahead_y - ty / 2;
    } while (heading.Holds(tx, ty));
  }
}

/// To the strongest of the three pixels ahead; false if it is too weak or has been visited.
bool ChainTracer::Step(const GradientMap& gradients, int threshold, const Heading& heading, int& at,
                       ChainPixel& pixel) {
  const unsigned short* const ahead = gradients.magnitude(0) + at + heading.ahead;
  int aside = 0, best = *ahead;
  if (ahead[-heading.side] > best) {
    aside = -1;
    best = ahead[-heading.side];
  }
  if (ahead[heading.side] > best) {
    aside = 1;
    best = ahead[heading.side];
  }
  at += heading.ahead + aside * heading.side;
  if (best <= threshold || std::exchange(visited_[at], 1) != 0) return false;
  pixel.x = static_cast<std::int16_t>(pixel.x + heading.tx + aside * heading.side_x);
  pixel.y = static_cast<std::int16_t>(pixel.y + heading.ty + aside * heading.side_y);
  return true;
}

}  // namespace priamos::head
