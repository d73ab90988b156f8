#include "head/core/edges/segment_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace priamos::head {

void SegmentMap::Clear(int width_px, int height_px) {
  columns_ = (width_px + 1) / 2;
  rows_ = (height_px + 1) / 2;
  cells_.assign(std::size_t(columns_) * rows_, 0);
}

void SegmentMap::Mark(double x, double y, std::uint16_t mark) {
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  if (column >= 0 && row >= 0 && column < columns_ && row < rows_)
    cells_[std::size_t(row) * columns_ + column] = mark;
}

void SegmentMap::Draw(const EdgeSegment& segment, int index) {
  if (index >= std::numeric_limits<std::uint16_t>::max()) return;
  const Eigen::Vector2d delta = (segment.end - segment.begin) / 2;
  const int n = std::max(1, static_cast<int>(delta.cwiseAbs().maxCoeff()));
  const bool steep = std::abs(delta.y()) >= std::abs(delta.x());
  const double aside_x = steep ? 0.5 : 0, aside_y = steep ? 0 : 0.5;  // a pixel to both sides
  // The centre of pixel 0 is a quarter of a cell inside.
  double x = segment.begin.x() / 2 + 0.25, y = segment.begin.y() / 2 + 0.25;
  for (int i = 0; i <= n; ++i, x += delta.x() / n, y += delta.y() / n) {
    Mark(x - aside_x, y - aside_y, static_cast<std::uint16_t>(index + 1));
    Mark(x + aside_x, y + aside_y, static_cast<std::uint16_t>(index + 1));
  }
}

std::uint16_t SegmentMap::MarkAt(const Eigen::Vector2d& at) const {
  const int column = static_cast<int>(at.x() / 2 + 0.25), row = static_cast<int>(at.y() / 2 + 0.25);
  const bool inside = column >= 0 && row >= 0 && column < columns_ && row < rows_;
  return inside ? cells_[std::size_t(row) * columns_ + column] : 0;
}

bool SegmentMap::Covers(const RoughLine& line, const std::vector<EdgeSegment>& segments) const {
  const Eigen::Vector2d begin(line.x1, line.y1), delta(line.x2 - line.x1, line.y2 - line.y1);
  const int mark = MarkAt(begin + 0.5 * delta);
  if (mark == 0) return false;
  int n_covered = 0;
  for (const double f : {0.1, 0.3, 0.7, 0.9}) n_covered += MarkAt(begin + f * delta) == mark;
  if (n_covered < 3) return false;
  const Eigen::Vector2d along = segments[mark - 1].end - segments[mark - 1].begin;
  return along.dot(delta) > 0.9 * delta.norm() * along.norm();
}

}  // namespace priamos::head
