#include "head/core/edge_chains.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace priamos::head {
namespace {

constexpr int kGrid = 8;  ///< seeds lie on every 8th row or column: a straight edge of 12 px crosses one

}  // namespace

/// To which of its four sides a walk goes on, and what a step is in memory and in x and y.
struct ChainTracer::Heading {
  int tx, ty;          ///< of a step ahead: (+-1, 0) or (0, +-1)
  int ahead, side;     ///< steps in memory
  int side_x, side_y;  ///< of a step to the side

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
  for (int y = 2; y < gradients.height() - 2; ++y) SeedColumns(gradients, options, y, chains);
}

/// No walk goes there, so none needs to look where the image ends.
void ChainTracer::CloseBorder(int height) {
  const auto close = [&](std::size_t from, std::size_t n) { std::fill_n(visited_.begin() + from, n, 1); };
  close(0, stride_), close(std::size_t(height - 1) * stride_, stride_);
  for (int y = 1; y < height; ++y) close(std::size_t(y) * stride_ - 1, 2);
}

/// Steep edges: strongest in the row.
void ChainTracer::SeedRow(const GradientMap& gradients, const Options& options, int y, EdgeChains& chains) {
  const unsigned short* const row = gradients.magnitude(y);
  const short *const gx = gradients.gx(y), *const gy = gradients.gy(y);
  const auto threshold = static_cast<unsigned short>(options.seed_threshold);
  // One branch for all: it is hardly ever taken.
  for (int x = 2; x < stride_ - 2; ++x) {
    if (int(row[x] >= threshold) & int(row[x] > row[x - 1]) & int(row[x] >= row[x + 1])) {
      if (std::abs(gx[x]) >= std::abs(gy[x])) TraceFrom(gradients, options, x, y, chains);
    }
  }
}

/// Flat edges: strongest in the column.
void ChainTracer::SeedColumns(const GradientMap& gradients, const Options& options, int y,
                              EdgeChains& chains) {
  const unsigned short *const row = gradients.magnitude(y), *const above = row - stride_,
                              *const below = row + stride_;
  const short *const gx = gradients.gx(y), *const gy = gradients.gy(y);
  const auto threshold = static_cast<unsigned short>(options.seed_threshold);
  for (int x = kGrid; x < stride_ - 2; x += kGrid) {
    if (int(row[x] >= threshold) & int(row[x] > above[x]) & int(row[x] >= below[x])) {
      if (std::abs(gx[x]) < std::abs(gy[x])) TraceFrom(gradients, options, x, y, chains);
    }
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
      tx += 2 * ahead_x - tx / 2, ty += 2 * ahead_y - ty / 2;
    } while (heading.Holds(tx, ty));
  }
}

/// To the strongest of the three pixels ahead; false if it is too weak or has been visited.
bool ChainTracer::Step(const GradientMap& gradients, int threshold, const Heading& heading, int& at,
                       ChainPixel& pixel) {
  const unsigned short* const ahead = gradients.magnitude(0) + at + heading.ahead;
  int aside = 0, best = *ahead;
  if (ahead[-heading.side] > best) aside = -1, best = ahead[-heading.side];
  if (ahead[heading.side] > best) aside = 1, best = ahead[heading.side];
  at += heading.ahead + aside * heading.side;
  if (best <= threshold || std::exchange(visited_[at], 1) != 0) return false;
  pixel.x = static_cast<std::int16_t>(pixel.x + heading.tx + aside * heading.side_x);
  pixel.y = static_cast<std::int16_t>(pixel.y + heading.ty + aside * heading.side_y);
  return true;
}

}  // namespace priamos::head
