#include "head/core/floor/line_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace priamos::head {
namespace {

constexpr std::size_t kMostLines = 4;  // that the world has
constexpr float kBorder_px = 8;        // rows of the picture in which nothing is measured
constexpr double kLeftOut_px = 1000;   // cost of a ridge that belongs to no line

ExpectedLine Expect(const CameraModel& camera, const LaserPlane& laser, std::size_t number,
                    const ImageSize& picture, const ObstacleOptions& options) {
  ExpectedLine line{number, LineRows(camera, laser, picture, options), {}, 0};
  line.row.resize(static_cast<std::size_t>(picture.width));
  const FloorLine floor(camera, laser);
  for (int u = 0; u < picture.width; ++u) {
    const auto point = floor.At(u);
    if (!point || point->row < kBorder_px || point->row > picture.height - 1 - kBorder_px) continue;
    line.row[static_cast<std::size_t>(u)] = static_cast<float>(point->row);
    ++line.columns;
  }
  return line;
}

double MiddleRow(const ExpectedLine& line) {
  double sum = 0;
  for (const auto& row : line.row) sum += row.value_or(0);
  return sum / std::max(1, line.columns);
}

/// The cheapest way to give the ridges of one column to lines without changing their order.
class Assignment {
 public:
  Assignment(std::span<const StripePoint> ridges, std::span<const ExpectedLine> lines)
      : ridges_(ridges), lines_(lines) {
    Try(0, 0, 0);
  }
  /// The line of a ridge; none: of no line.
  std::optional<std::size_t> LineOf(std::size_t ridge) const { return best_[ridge]; }

 private:
  using Choice = std::array<std::optional<std::size_t>, kMostLines>;

  void Try(std::size_t ridge, std::size_t first_line, double cost) {
    if (cost >= best_cost_) return;
    if (ridge == ridges_.size()) {
      best_ = choice_;
      best_cost_ = cost;
      return;
    }
    for (std::size_t k = first_line; k < lines_.size(); ++k) {
      const auto distance = Distance(ridges_[ridge], lines_[k]);
      if (!distance) continue;
      choice_[ridge] = k;
      Try(ridge + 1, k + 1, cost + *distance);
    }
    choice_[ridge].reset();
    Try(ridge + 1, first_line, cost + kLeftOut_px);
  }
  static std::optional<double> Distance(const StripePoint& ridge, const ExpectedLine& line) {
    const auto expected = line.row[static_cast<std::size_t>(ridge.at.x())];
    if (!expected || ridge.at.y() < line.rows.first || ridge.at.y() > line.rows.last) return std::nullopt;
    return std::abs(ridge.at.y() - *expected);
  }

  std::span<const StripePoint> ridges_;
  std::span<const ExpectedLine> lines_;
  Choice choice_{}, best_{};
  double best_cost_ = 1e9;
};

}  // namespace

std::vector<ExpectedLine> ExpectLines(const CameraModel& camera, std::span<const LaserPlane> lasers,
                                      const ImageSize& picture, const ObstacleOptions& options) {
  std::vector<ExpectedLine> lines;
  for (std::size_t k = 0; k < lasers.size() && k < kMostLines; ++k) {
    ExpectedLine line = Expect(camera, lasers[k], k, picture, options);
    if (line.columns > 0 && line.rows.first < line.rows.last) lines.push_back(std::move(line));
  }
  std::ranges::stable_sort(lines, {}, MiddleRow);
  return lines;
}

std::vector<std::vector<StripePoint>> TellApart(std::span<const StripePoint> ridges,
                                                std::span<const ExpectedLine> lines) {
  std::vector<std::vector<StripePoint>> points(lines.size());
  for (std::size_t begin = 0, end = 0; begin < ridges.size(); begin = end) {
    while (end < ridges.size() && ridges[end].at.x() == ridges[begin].at.x()) ++end;
    const auto column = ridges.subspan(begin, std::min(end - begin, kMostLines));
    const Assignment told(column, lines);
    for (std::size_t i = 0; i < column.size(); ++i) {
      if (const auto line = told.LineOf(i)) points[*line].push_back(column[i]);
    }
  }
  return points;
}

}  // namespace priamos::head
