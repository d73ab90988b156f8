#include "head/core/edges/segment_index.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::head {

SegmentIndex::SegmentIndex(int width_px, int height_px, double cell_px)
    : cell_px_(cell_px),
      columns_(std::max(1, static_cast<int>(std::ceil(width_px / cell_px)))),
      rows_(std::max(1, static_cast<int>(std::ceil(height_px / cell_px)))),
      first_(std::size_t(columns_) * rows_, -1) {}

int SegmentIndex::Column(double x) const {
  return static_cast<int>(std::clamp(x / cell_px_, 0.0, columns_ - 1.0));
}
int SegmentIndex::Row(double y) const {
  return static_cast<int>(std::clamp(y / cell_px_, 0.0, rows_ - 1.0));
}

void SegmentIndex::Insert(int id, const Eigen::Vector2d& begin, const Eigen::Vector2d& end) {
  const int steps = 1 + static_cast<int>((end - begin).norm() / (cell_px_ / 2));
  int last = -1;
  for (int i = 0; i <= steps; ++i) {
    const Eigen::Vector2d at = begin + (end - begin) * (double(i) / steps);
    const int cell = Row(at.y()) * columns_ + Column(at.x());
    if (cell == last) continue;
    entries_.push_back({id, first_[cell]});
    first_[cell] = static_cast<int>(entries_.size()) - 1;
    last = cell;
  }
}

void SegmentIndex::Near(const Eigen::Vector2d& at, double reach_px, std::vector<int>& found) const {
  const double reach = reach_px + cell_px_ / 4;  // a segment stands in the cells of its samples only
  const int right = Column(at.x() + reach), bottom = Row(at.y() + reach);
  for (int row = Row(at.y() - reach); row <= bottom; ++row) {
    for (int column = Column(at.x() - reach); column <= right; ++column) {
      for (int e = first_[std::size_t(row) * columns_ + column]; e >= 0; e = entries_[e].next) {
        found.push_back(entries_[e].id);
      }
    }
  }
}

void SegmentIndex::Along(const Eigen::Vector2d& begin, const Eigen::Vector2d& end, double reach_px,
                         std::vector<int>& found) const {
  const int steps = 1 + static_cast<int>((end - begin).norm() / cell_px_);
  for (int i = 0; i <= steps; ++i) {
    Near(begin + (end - begin) * (double(i) / steps), reach_px + cell_px_ / 2, found);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
}

}  // namespace priamos::head
