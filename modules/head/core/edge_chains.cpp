#include "head/core/edge_chains.hpp"

#include <algorithm>
#include <cstdlib>

namespace priamos::head {
namespace {

constexpr int kGrid = 8;  ///< seeds lie on every 8th row or column: a straight edge of 12 px crosses one

/// Strongest across a steep edge.
bool IsPeakInRow(const GradientMap& gradients, int x, int y) {
  const unsigned short* row = gradients.magnitude(y);
  return std::abs(gradients.gx(y)[x]) >= std::abs(gradients.gy(y)[x]) && row[x] > row[x - 1] &&
         row[x] >= row[x + 1];
}

/// Strongest across a flat edge.
bool IsPeakInColumn(const GradientMap& gradients, int x, int y) {
  return std::abs(gradients.gx(y)[x]) < std::abs(gradients.gy(y)[x]) &&
         gradients.magnitude(y)[x] > gradients.magnitude(y - 1)[x] &&
         gradients.magnitude(y)[x] >= gradients.magnitude(y + 1)[x];
}

}  // namespace

void ChainTracer::Trace(const GradientMap& gradients, const Options& options, EdgeChains& chains) {
  stride_ = gradients.width();
  visited_.assign(std::size_t(gradients.width()) * gradients.height(), 0);
  chains.pixels.clear();
  chains.begins.assign(1, 0);
  const int threshold = static_cast<int>(options.seed_threshold);
  const auto is_free = [&](int x, int y) { return !visited_[std::size_t(y) * stride_ + x]; };
  for (int y = 2; y < gradients.height() - 2; ++y) {
    const unsigned short* magnitude = gradients.magnitude(y);
    const int step = y % kGrid == 0 ? 1 : kGrid;
    for (int x = step == 1 ? 2 : kGrid; x < gradients.width() - 2; x += step) {
      if (magnitude[x] < threshold || !is_free(x, y)) continue;
      if ((y % kGrid == 0 && IsPeakInRow(gradients, x, y)) ||
          (x % kGrid == 0 && IsPeakInColumn(gradients, x, y))) {
        TraceFrom(gradients, options, x, y, chains);
      }
    }
  }
}

void ChainTracer::TraceFrom(const GradientMap& gradients, const Options& options, int x, int y,
                            EdgeChains& chains) {
  const int threshold = static_cast<int>(options.link_threshold);
  visited_[std::size_t(y) * stride_ + x] = 1;
  walk_.clear();
  Follow(gradients, threshold, x, y, -1);
  std::reverse(walk_.begin(), walk_.end());
  walk_.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)});
  Follow(gradients, threshold, x, y, 1);
  if (static_cast<int>(walk_.size()) < options.min_pixels) return;
  chains.pixels.insert(chains.pixels.end(), walk_.begin(), walk_.end());
  chains.begins.push_back(static_cast<int>(chains.pixels.size()));
}

void ChainTracer::Follow(const GradientMap& gradients, int threshold, int x, int y, int hand) {
  const unsigned short* const magnitude = gradients.magnitude(0);
  const short *const gx = gradients.gx(0), *const gy = gradients.gy(0);
  const int right = gradients.width() - 2, bottom = gradients.height() - 2;
  int at = y * stride_ + x;
  // The tangent (gy, -gx) has the bright side on the right; averaged over a few pixels, or noise would turn
  // the walk where the edge is diagonal.
  int tx = 4 * hand * gy[at], ty = -4 * hand * gx[at];
  while (true) {
    const bool steep = std::abs(ty) >= std::abs(tx);
    const int step = steep ? (ty > 0 ? stride_ : -stride_) : (tx > 0 ? 1 : -1), side = steep ? 1 : stride_;
    int next = at + step, best = magnitude[next];
    if (magnitude[at + step - side] > best) next = at + step - side, best = magnitude[next];
    if (magnitude[at + step + side] > best) next = at + step + side, best = magnitude[next];
    if (best <= threshold || visited_[next]) return;
    const int ahead_x = hand * gy[next], ahead_y = -hand * gx[next];
    if (std::int64_t(ahead_x) * tx + std::int64_t(ahead_y) * ty <= 0) return;  // an edge of other contrast
    visited_[next] = 1;
    const int across = next - at - step;  // 0 or one step sideways
    if (steep) {
      y += ty > 0 ? 1 : -1, x += across;
    } else {
      x += tx > 0 ? 1 : -1, y += across == 0 ? 0 : across > 0 ? 1 : -1;
    }
    if (x < 1 || y < 1 || x > right || y > bottom) return;
    walk_.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y)});
    at = next;
    tx += ahead_x - tx / 4, ty += ahead_y - ty / 4;
  }
}

}  // namespace priamos::head
