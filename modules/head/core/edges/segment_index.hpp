#pragma once

#include <Eigen/Core>
#include <vector>

namespace priamos::head {

/// Which segments pass near a point. A grid of square cells over the image, every cell with a list of the
/// segments that cross it: a segment has as many entries as it is long in cells, so building and queries
/// take linear time. Points outside the image count to its border cells.
class SegmentIndex {
 public:
  SegmentIndex(int width_px, int height_px, double cell_px);

  void Insert(int id, const Eigen::Vector2d& begin, const Eigen::Vector2d& end);
  /// Adds to `found` every segment that comes within `reach_px` of `at`, and some that do not; each may come
  /// several times.
  void Near(const Eigen::Vector2d& at, double reach_px, std::vector<int>& found) const;
  /// Adds to `found` every segment that comes within `reach_px` of a point between `begin` and `end`, then
  /// sorts `found`, each id once.
  void Along(const Eigen::Vector2d& begin, const Eigen::Vector2d& end, double reach_px,
             std::vector<int>& found) const;

 private:
  struct Entry {
    int id, next;
  };
  int Column(double x) const;
  int Row(double y) const;

  double cell_px_;
  int columns_, rows_;
  std::vector<int> first_;  ///< entry of each cell, -1 if empty
  std::vector<Entry> entries_;
};

}  // namespace priamos::head
