#include "head/core/landmark/edge_field.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"

namespace priamos::head {
namespace {

constexpr double kCellsPerSigma = 1.6;
constexpr double kReach_sigmas = 2.5;  ///< beyond, an edge is not felt
constexpr double kTurn_rad = 0.12;     ///< by so much an edge may be turned against its prediction
constexpr int kMaxCells = 400;         ///< along each side
constexpr double kMargin = 1e-6;       ///< more than steps along a line are off by rounding [cells]

}  // namespace

EdgeField::EdgeField(const CameraView& view, const FieldRegion& region, double sigma_px)
    : from_(region.from), cell_px_(sigma_px / kCellsPerSigma) {
  const Eigen::Vector2d extent = (region.to - region.from).cwiseMax(1.0);
  cell_px_ = std::max(cell_px_, extent.maxCoeff() / kMaxCells);
  width_ = static_cast<int>(extent.x() / cell_px_) + 1;
  height_ = static_cast<int>(extent.y() / cell_px_) + 1;
  const std::size_t plane = static_cast<std::size_t>(width_) * height_;
  cells_.assign(kDirections * plane, 0);
  const double reach_px = kReach_sigmas * sigma_px;
  for (const ViewLine& line : view.lines) {
    const Eigen::Vector2d low = line.p.cwiseMin(line.q), high = line.p.cwiseMax(line.q);
    if ((low - region.to).maxCoeff() > reach_px || (region.from - high).maxCoeff() > reach_px) continue;
    Draw(line, sigma_px / cell_px_);
  }
  SetMeans(plane);
}

/// Of several directions at once: a sum waits for its last addition.
void EdgeField::SetMeans(std::size_t plane) {
  constexpr int kAtOnce = 4;
  static_assert(kDirections % kAtOnce == 0);
  for (int d = 0; d < kDirections; d += kAtOnce) {
    const float* cells = &cells_[d * plane];
    double sums[kAtOnce] = {};
    for (std::size_t i = 0; i < plane; ++i)
      for (int k = 0; k < kAtOnce; ++k) sums[k] += cells[k * plane + i];
    for (int k = 0; k < kAtOnce; ++k) mean_[d + k] = sums[k] / static_cast<double>(plane);
  }
}

/// The multiple of 15 degrees nearest to the direction of `d`, forth or back. By the tangents of the angles
/// between them: ten thousands are asked for a body.
int EdgeField::DirectionOf(const Eigen::Vector2d& d) {
  static_assert(kDirections == 12);
  constexpr double kTangents[] = {0.13165249758739585, 0.41421356237309503, 0.76732698797896037,
                                  1.3032253728412058,  2.4142135623730949,  7.5957541127251504};
  const double x = std::abs(d.x()), y = std::abs(d.y());
  int k = 0;
  for (const double tangent : kTangents) k += y >= tangent * x;
  if (x == 0 && y == 0) k = 0;
  return (d.x() < 0) == (d.y() < 0) ? k : (kDirections - k) % kDirections;
}

void EdgeField::Raise(int x, int y, int first_direction, int n_directions, float value) {
  for (int k = 0; k < n_directions; ++k) {
    const int direction = (first_direction + k + kDirections) % kDirections;
    float& cell = cells_[(direction * height_ + y) * width_ + x];
    cell = std::max(cell, value);
  }
}

/// Steps along the axis that the line follows more, and sets the cells across it.
void EdgeField::Draw(const ViewLine& line, double sigma_cells) {
  const double turn_rad = kTurn_rad + 1 / line.length_px;  // one pixel is noise for a short line
  const int turns =
      std::min(kDirections / 2 - 1, static_cast<int>(std::lround(turn_rad * kDirections / kPi)));
  const int first_direction = DirectionOf(line.q - line.p) - turns, n_directions = 2 * turns + 1;
  Eigen::Vector2d p = (line.p - from_) / cell_px_, q = (line.q - from_) / cell_px_;
  const bool is_steep = std::abs(q.y() - p.y()) > std::abs(q.x() - p.x());
  if (is_steep) {
    std::swap(p.x(), p.y());
    std::swap(q.x(), q.y());
  }
  if (p.x() > q.x()) std::swap(p, q);
  const int n_along = is_steep ? height_ : width_, n_across = is_steep ? width_ : height_;
  const double slope = (q.y() - p.y()) / std::max(1e-9, q.x() - p.x()), cosine = 1 / std::hypot(1.0, slope);
  const double reach = kReach_sigmas * sigma_cells / cosine;
  const float decay = static_cast<float>(0.5 * cosine * cosine / (sigma_cells * sigma_cells));
  const int first = static_cast<int>(std::max(0.0, p.x()));
  const int last = static_cast<int>(std::min(n_along - 1.0, q.x()));
  for (int i = first; i <= last; ++i) {
    const double middle = p.y() + slope * (i + 0.5 - p.x());
    const int low = static_cast<int>(std::clamp(middle - reach, 0.0, n_across - 1.0));
    const int high = static_cast<int>(std::clamp(middle + reach, -1.0, n_across - 1.0));
    for (int j = low; j <= high; ++j) {
      const auto d = static_cast<float>(j + 0.5 - middle);
      Raise(is_steep ? j : i, is_steep ? i : j, first_direction, n_directions, std::exp(-decay * d * d));
    }
  }
}

double EdgeField::Along(const Eigen::Vector2d& p, const Eigen::Vector2d& q) const {
  const Eigen::Vector2d a = (p - from_) / cell_px_, b = (q - from_) / cell_px_;
  const int n = 2 + static_cast<int>((b - a).norm() / 2);
  const Eigen::Vector2d step = (b - a) / n;
  const int direction = DirectionOf(b - a);
  const float* plane = &cells_[static_cast<std::size_t>(direction) * width_ * height_];
  const auto value = [&](const Eigen::Vector2d& at) {
    return plane[static_cast<int>(at.y()) * width_ + static_cast<int>(at.x())];
  };
  Eigen::Vector2d at = a + step / 2;
  double sum = 0;
  if (Holds(at, kMargin) && Holds(b - step / 2, kMargin)) {  // and so all between them
    for (int i = 0; i < n; ++i, at += step) sum += value(at);
  } else {
    for (int i = 0; i < n; ++i, at += step)
      if (Holds(at, 0)) sum += value(at);
  }
  return sum / n - mean_[direction];
}

}  // namespace priamos::head
