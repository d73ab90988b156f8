#include "planner/core/locate/place_grid.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace priamos::planner {
namespace {

/// Half a cell, and half a step of the heading at this lever, are no reason to be out.
constexpr double kHalfStep_rad = 0.0175;

int CellsIn(double length_m) {
  return 1 + static_cast<int>(std::max(0.0, length_m) / PlaceGrid::kCell_m);
}

}  // namespace

PlaceGrid::PlaceGrid(const PlacePlan& plan, const PlaceScorer& scorer)
    : plan_(plan),
      scorer_(scorer),
      columns_(CellsIn(plan.bounds().sizes().x())),
      rows_(CellsIn(plan.bounds().sizes().y())) {
  total_.resize(std::size_t(columns_) * std::size_t(rows_));
  of_piece_.resize(total_.size());
}

Eigen::Vector2d PlaceGrid::PlaceOf(std::size_t cell) const {
  const auto columns = static_cast<std::size_t>(columns_);
  return plan_.bounds().min() +
         kCell_m * Eigen::Vector2d(double(cell % columns) + 0.5, double(cell / columns) + 0.5);
}

double PlaceGrid::Bound(double map_yaw) const {
  double bound = 0;
  for (const PlaceScorer::Piece& piece : scorer_.pieces()) {
    double best = 0;
    for (const PlaceFace& face : plan_.faces())
      if (const auto cost = scorer_.TurnCost(piece, face, map_yaw))
        best = std::max(best, piece.gain - *cost / 2);
    bound += best;
  }
  return bound;
}

void PlaceGrid::Fill(double map_yaw) {
  std::fill(total_.begin(), total_.end(), 0.0F);
  for (const PlaceScorer::Piece& piece : scorer_.pieces()) {
    std::fill(of_piece_.begin(), of_piece_.end(), 0.0F);
    for (const PlaceFace& face : plan_.faces())
      if (const auto cost = scorer_.TurnCost(piece, face, map_yaw)) Add(piece, face, *cost, map_yaw);
    for (std::size_t i = 0; i < total_.size(); ++i) total_[i] += of_piece_[i];
  }
}

/// The places from which the piece lies on the face are a strip beside it.
void PlaceGrid::Add(const PlaceScorer::Piece& piece, const PlaceFace& face, double turn_cost,
                    double map_yaw) {
  const Eigen::Vector2d to_middle = Pose2{0, 0, map_yaw} * piece.base_from_middle.translation();
  const double variance =
      piece.across_variance + kCell_m * kCell_m / 4 + std::pow(kHalfStep_rad * face.along.dot(to_middle), 2);
  const double reach_m = std::sqrt(2 * piece.gain * variance), slack_m = scorer_.Overhang_m(piece);
  const Eigen::Vector2d begin = face.from - to_middle;
  Eigen::AlignedBox2d strip;
  for (const double at_m : {piece.length_m / 2 - slack_m, face.length_m - piece.length_m / 2 + slack_m})
    for (const double across_m : {-reach_m, reach_m})
      strip.extend(Eigen::Vector2d(begin + at_m * face.along + across_m * face.left()));
  const Eigen::Vector2d low = (strip.min() - plan_.bounds().min()) / kCell_m;
  const Eigen::Vector2d high = (strip.max() - plan_.bounds().min()) / kCell_m;
  const int first_row = std::max(0, static_cast<int>(std::floor(low.y()))),
            last_row = std::min(rows_ - 1, static_cast<int>(std::floor(high.y()))),
            first = std::max(0, static_cast<int>(std::floor(low.x()))),
            last = std::min(columns_ - 1, static_cast<int>(std::floor(high.x())));
  for (int row = first_row; row <= last_row; ++row)
    for (int column = first; column <= last; ++column) {
      const std::size_t cell = std::size_t(row) * std::size_t(columns_) + std::size_t(column);
      const Eigen::Vector2d offset = PlaceOf(cell) - begin;
      const double across_m = face.left().dot(offset), at_m = face.along.dot(offset);
      const double overhang_m =
          std::max({0.0, piece.length_m / 2 - at_m, at_m + piece.length_m / 2 - face.length_m});
      const double worth =
          piece.gain - (turn_cost + across_m * across_m / variance + scorer_.OverhangCost(overhang_m)) / 2;
      of_piece_[cell] = std::max(of_piece_[cell], static_cast<float>(worth));
    }
}

}  // namespace priamos::planner
