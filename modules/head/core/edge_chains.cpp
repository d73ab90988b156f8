#include "head/core/edge_chains.hpp"

#include <algorithm>
#include <cstdlib>

namespace priamos::head {
namespace {

constexpr int kGrid = 4;  ///< seeds lie on every 4th row or column: no straight edge of 8 px slips through

}  // namespace

void ChainTracer::Trace(const GradientMap& gradients, const Options& options, EdgeChains& chains) {
  stride_ = gradients.width();
  visited_.assign(std::size_t(gradients.width()) * gradients.height(), 0);
  chains.pixels.clear();
  chains.begins.assign(1, 0);
  const int threshold = static_cast<int>(options.seed_threshold);
  for (int y = 2; y < gradients.height() - 2; ++y) {
    const short *gx = gradients.gx(y), *gy = gradients.gy(y);
    const unsigned short* magnitude = gradients.magnitude(y);
    const unsigned short *above = gradients.magnitude(y - 1), *below = gradients.magnitude(y + 1);
    const bool grid_row = y % kGrid == 0;
    for (int x = grid_row ? 2 : kGrid; x < gradients.width() - 2; x += grid_row ? 1 : kGrid) {
      const int m = magnitude[x];
      if (m < threshold) continue;
      const bool steep = std::abs(gx[x]) >= std::abs(gy[x]);
      const bool peak = steep ? grid_row && m > magnitude[x - 1] && m >= magnitude[x + 1]
                              : x % kGrid == 0 && m > above[x] && m >= below[x];
      if (peak && !visited_[std::size_t(y) * stride_ + x]) TraceFrom(gradients, options, x, y, chains);
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
  // The tangent (gy, -gx) has the bright side on the right; averaged over a few pixels, or noise would turn
  // the walk where the edge is diagonal.
  int tx = 4 * hand * gradients.gy(y)[x], ty = -4 * hand * gradients.gx(y)[x];
  const int right = gradients.width() - 2, bottom = gradients.height() - 2;
  while (true) {
    int best = threshold, next_x = -1, next_y = -1;
    if (std::abs(ty) >= std::abs(tx)) {
      const int ahead = ty > 0 ? y + 1 : y - 1;
      if (ahead < 1 || ahead > bottom) return;
      const unsigned short* row = gradients.magnitude(ahead);
      const int order[3] = {x, x - 1, x + 1};
      for (const int u : order) {
        if (row[u] > best) best = row[u], next_x = u, next_y = ahead;
      }
    } else {
      const int ahead = tx > 0 ? x + 1 : x - 1;
      if (ahead < 1 || ahead > right) return;
      const int order[3] = {y, y - 1, y + 1};
      for (const int v : order) {
        const int m = gradients.magnitude(v)[ahead];
        if (m > best) best = m, next_x = ahead, next_y = v;
      }
    }
    if (next_x < 1 || next_y < 1 || next_x > right || next_y > bottom) return;
    std::uint8_t& visited = visited_[std::size_t(next_y) * stride_ + next_x];
    if (visited) return;
    const int gx = hand * gradients.gy(next_y)[next_x], gy = -hand * gradients.gx(next_y)[next_x];
    if (std::int64_t(gx) * tx + std::int64_t(gy) * ty <= 0) return;  // the edge ends at one of other contrast
    visited = 1;
    walk_.push_back({static_cast<std::int16_t>(next_x), static_cast<std::int16_t>(next_y)});
    x = next_x, y = next_y;
    tx += gx - tx / 4, ty += gy - ty / 4;
  }
}

}  // namespace priamos::head
