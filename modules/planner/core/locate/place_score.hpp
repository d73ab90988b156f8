#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "planner/core/locate/driven_way.hpp"
#include "planner/core/locate/place_plan.hpp"

namespace priamos::planner {

/// How far what was heard may lie beside what the plan has, and what each finding is worth.
struct PlaceScoreConfig {
  double across_m = 0.03;             ///< standard deviation of a piece across it, by its fit
  double turned_deg = 1.5;            ///< and of its direction against the plan's wall
  double drift_m_per_sqrt_m = 0.02;   ///< what the way loses with the distance driven since
  double drift_deg_per_sqrt_m = 0.3;  ///< and of the heading
  double overhang_m = 0.2;            ///< of the end of a piece beyond the end of its wall
  double least_gain = 2.5;            ///< log-odds of a short piece being the wall that lies just there ...
  double gain_per_m = 2;              ///< ... and more for its length, up to 4 m: few things are so long
  double hidden = 1.5;                ///< log-odds against a piece that lies behind a wall
  double in_wall = 4;                 ///< against each place of the trail in a wall

  void Describe(Archive& a);
};

/// How well one place on the plan explains a drive.
struct PlaceFit {
  Pose2 map_from_base;
  Eigen::Matrix3d information =
      Eigen::Matrix3d::Zero();  ///< of (x, y, yaw), by the walls that match [m, rad]
  double score = 0;             ///< log-likelihood against "none of it is on the plan"
  int matched = 0;              ///< pieces that lie on walls of the plan
  bool crossed = false;         ///< and they hold the place in both directions
};

/// Weighs places on the plan by what was heard and driven over. A piece is a wall of the plan, or a thing
/// that is not on it: a mixture, so that no single piece decides. Against a place speaks what no thing
/// explains: drives through walls, and, less, sound that came from behind one: an echo of an echo does, and
/// at the true place 6 of 56 pieces were such.
class PlaceScorer {
 public:
  /// A piece relative to the base as it is now.
  struct Piece {
    Pose2 base_from_middle;
    double length_m = 0;
    double across_variance = 0, yaw_variance = 0;
    double gain = 0;
    Eigen::Vector2d heard_from{0, 0}, foot{0, 0};  ///< of the sound, frame of the base
  };

  PlaceScorer(const PlaceScoreConfig& config, const PlacePlan& plan, const DrivenWay& way);

  const std::vector<Piece>& pieces() const { return pieces_; }
  /// The wall's share of the squared distance of a piece from a face, by the direction alone; nullopt: too
  /// far turned.
  std::optional<double> TurnCost(const Piece& piece, const PlaceFace& face, double map_yaw) const;
  /// And by how far it hangs over the end of its wall.
  double OverhangCost(double overhang_m) const {
    return overhang_m * overhang_m / (config_.overhang_m * config_.overhang_m);
  }
  /// The farthest that it may hang over.
  double Overhang_m(const Piece& piece) const { return config_.overhang_m * std::sqrt(2 * piece.gain); }
  /// What speaks against a base at a place: sound and drives through walls; 0 or negative.
  double Penalty(const Pose2& map_from_base) const;
  /// The best place near one: a few steps of least squares on the walls that match there.
  PlaceFit Refined(const Pose2& map_from_base) const;

 private:
  struct Match {
    const PlaceFace* face = nullptr;
    double worth = 0;     ///< gain less half the squared distance
    double across_m = 0;  ///< of the piece's middle, to the left of the face
    double turned_rad = 0;
  };
  Match BestOf(const Piece& piece, const Pose2& map_from_base) const;
  PlaceFit FitAt(const Pose2& map_from_base, Eigen::Vector3d& gradient) const;

  PlaceScoreConfig config_;
  const PlacePlan& plan_;
  std::vector<Piece> pieces_;
  std::vector<Eigen::Vector2d> trail_;  ///< frame of the base as it is now
};

}  // namespace priamos::planner
