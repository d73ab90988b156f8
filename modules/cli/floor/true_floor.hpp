#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <utility>
#include <vector>

#include "cli/scenario/true_world.hpp"
#include "common/rectangle.hpp"

namespace priamos::cli {

/// Outlines of the true solids that reach into these heights above the floor, map frame.
std::vector<Rectangle> OutlinesAt(const TrueWorld& world, double low_m, double high_m);

/// The true floor in cells of 10 cm: where a base gets from its start, and what of that it has seen.
class TrueFloor {
 public:
  static constexpr double kStep_m = 0.1;
  /// What the base sees of the floor lies so near.
  static constexpr double kSight_m = 2.0;

  /// The base keeps 10 cm off everything; its start, map frame.
  TrueFloor(const TrueWorld& world, const Eigen::Vector2d& start);

  /// The base is here, map frame, and sees what nothing hides.
  void SeeFrom(const Eigen::Vector2d& at);
  /// The cells that are seen from there, in no order and some twice.
  std::vector<std::size_t> CellsSeenFrom(const Eigen::Vector2d& at) const;

  int nx() const { return nx_; }
  int ny() const { return ny_; }
  std::size_t cells() const { return gap_m_.size(); }
  Eigen::Vector2d PlaceOf(int x, int y) const {
    return origin_ + kStep_m * Eigen::Vector2d(x + 0.5, y + 0.5);
  }
  /// -1 outside.
  int IndexAt(const Eigen::Vector2d& in_map) const;
  /// Whether the middle of the base gets there, and whether it covers the cell then.
  bool HasMiddle(std::size_t cell) const { return middle_[cell]; }
  bool IsReachable(std::size_t cell) const { return reachable_[cell]; }

  double reachable_m2() const;
  /// Share of what can be reached that was seen.
  double seen() const;

 private:
  /// Inside alone.
  std::size_t CellAt(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(x);
  }
  void Measure(const Rectangle& outline);
  void Flood(const Eigen::Vector2d& start, double least_m);
  void Widen(double by_m);

  Eigen::Vector2d origin_{0, 0};
  int nx_ = 0, ny_ = 0;
  std::vector<float> gap_m_;  ///< to the nearest solid, 1 m at most
  std::vector<bool> middle_, reachable_, seen_;
};

}  // namespace priamos::cli
