#include "head/core/contours/polygon_search.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"

namespace priamos::head {
namespace {

/// Walks from corner to corner along the segments, always turning right, until it is back where it began.
class PolygonSearch {
 public:
  PolygonSearch(const EdgeImage& edges, std::span<const Corner> corners,
                std::span<const std::vector<int>> corners_of, const ContourOptions& options)
      : edges_(edges), corners_(corners), corners_of_(corners_of), options_(options) {}

  std::vector<Polygon> Run() {
    for (int i = 0; i < static_cast<int>(edges_.segments.size()); ++i) {
      for (const int end : {0, 1}) {
        first_ = i;
        first_end_ = end;
        sides_.assign(1, i);
        path_.clear();
        Continue(i, end, 0);
      }
    }
    return std::move(polygons_);
  }

 private:
  /// Direction in which a segment is left through `end`.
  Eigen::Vector2d Heading(int segment, int end) const {
    const Eigen::Vector2d d = edges_.segments[segment].direction();
    return end == 1 ? d : Eigen::Vector2d(-d);
  }

  void Continue(int segment, int end, double turned_rad) {
    for (const int c : corners_of_[2 * segment + end]) {
      const Corner& corner = corners_[c];
      const int k = corner.segments[0] == segment && corner.ends[0] == end ? 1 : 0;
      const int next = corner.segments[k], next_end = 1 - corner.ends[k];
      // Every outline is found once: from the side with the smallest index.
      if (next < first_) continue;
      const Eigen::Vector2d u = Heading(segment, end), v = Heading(next, next_end);
      const double turn = std::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v));
      if (turn < options_.min_corner_rad || turned_rad + turn > 2 * kPi + 1e-6) continue;
      if (!path_.empty() && !RunsForward(segment, end, path_.back(), c)) continue;
      path_.push_back(c);
      if (next == first_) {
        if (next_end == first_end_) Close(turned_rad + turn);
      } else if (sides_.size() < std::size_t(options_.max_sides) &&
                 std::find(sides_.begin(), sides_.end(), next) == sides_.end()) {
        sides_.push_back(next);
        Continue(next, next_end, turned_rad + turn);
        sides_.pop_back();
      }
      path_.pop_back();
    }
  }

  /// Both corners of a side in the right order, with something of the side between them.
  bool RunsForward(int segment, int end, int from, int to) const {
    return Heading(segment, end).dot(corners_[to].at - corners_[from].at) >
           0.3 * edges_.segments[segment].length_px();
  }

  void Close(double turned_rad) {
    if (path_.size() < 3 || std::abs(turned_rad - 2 * kPi) > 0.01) return;
    if (!RunsForward(first_, first_end_, path_.back(), path_.front())) return;
    Polygon polygon;
    polygon.sides = sides_;
    // Side i leaves through path_[i], so it begins at the corner before.
    polygon.corners.push_back(path_.back());
    polygon.corners.insert(polygon.corners.end(), path_.begin(), path_.end() - 1);
    polygon.is_parallelogram = IsParallelogram();
    polygons_.push_back(std::move(polygon));
  }

  bool IsParallelogram() const {
    if (sides_.size() != 4) return false;
    for (int i = 0; i < 2; ++i) {
      const EdgeSegment &a = edges_.segments[sides_[i]], &b = edges_.segments[sides_[i + 2]];
      const Eigen::Vector2d u = a.direction(), v = b.direction();
      const double noise = std::hypot(a.sigma_angle_rad, b.sigma_angle_rad);
      if (std::abs(u.x() * v.y() - u.y() * v.x()) > std::sin(options_.perspective_rad) + 3 * noise)
        return false;
    }
    return true;
  }

  const EdgeImage& edges_;
  std::span<const Corner> corners_;
  std::span<const std::vector<int>> corners_of_;
  const ContourOptions& options_;
  int first_ = 0, first_end_ = 0;
  std::vector<int> sides_, path_;
  std::vector<Polygon> polygons_;
};

}  // namespace

std::vector<Polygon> FindPolygons(const EdgeImage& edges, std::span<const Corner> corners,
                                  std::span<const std::vector<int>> corners_of,
                                  const ContourOptions& options) {
  return PolygonSearch(edges, corners, corners_of, options).Run();
}

}  // namespace priamos::head
