#pragma once

#include <cstddef>
#include <vector>

#include "planner/core/locate/place_plan.hpp"
#include "planner/core/locate/place_score.hpp"

namespace priamos::planner {

/// What the walls that were heard say of every place of the plan, for one heading of the base: the sum, over
/// all pieces, of what each is worth there. Without what speaks against a place.
class PlaceGrid {
 public:
  static constexpr double kCell_m = 0.1;

  PlaceGrid(const PlacePlan& plan, const PlaceScorer& scorer);

  /// The most that any place can have with this heading.
  double Bound(double map_yaw) const;
  /// Reckons all places anew.
  void Fill(double map_yaw);

  std::size_t size() const { return total_.size(); }
  float at(std::size_t cell) const { return total_[cell]; }
  Eigen::Vector2d PlaceOf(std::size_t cell) const;
  int columns() const { return columns_; }

 private:
  void Add(const PlaceScorer::Piece& piece, const PlaceFace& face, double turn_cost, double map_yaw);

  const PlacePlan& plan_;
  const PlaceScorer& scorer_;
  int columns_ = 0, rows_ = 0;
  std::vector<float> total_, of_piece_;
};

}  // namespace priamos::planner
