#pragma once

#include <cstdint>
#include <vector>

#include "head/core/edges/chain_split.hpp"
#include "head/core/edges/edge_segment.hpp"

namespace priamos::head {

/// Which segment runs over a pixel, in cells of 2x2 pixels: so that pieces of an edge that has been found
/// as a whole are recognised quickly.
class SegmentMap {
 public:
  void Clear(int width_px, int height_px);
  /// Draws a segment; `index` is that of the segment in EdgeImage::segments; beyond 65 534 it is not drawn.
  void Draw(const EdgeSegment& segment, int index);
  /// True if nearly all of `line` runs on one of `segments`, with the same contrast sign.
  bool Covers(const RoughLine& line, const std::vector<EdgeSegment>& segments) const;

 private:
  void Mark(double x, double y, std::uint16_t mark);
  std::uint16_t MarkAt(const Eigen::Vector2d& at) const;

  int columns_ = 0, rows_ = 0;
  std::vector<std::uint16_t> cells_;  ///< 1 + index of the segment, 0 where there is none
};

}  // namespace priamos::head
