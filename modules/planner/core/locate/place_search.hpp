#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "planner/core/locate/place_plan.hpp"
#include "planner/core/locate/place_score.hpp"

namespace priamos::planner {

/// Which places count as explaining a drive, and when one of them is alone.
struct PlaceSearchConfig {
  PlaceScoreConfig score;
  double margin = 10;    ///< log-likelihood by which a place must be worse than the best to be out
  double same_m = 0.5;   ///< places no farther apart are one ...
  double same_deg = 10;  ///< ... nor turned more

  void Describe(Archive& a);
};

/// Places on the plan that explain a drive: around a pose, and how well it is known.
struct PlaceCandidate {
  Pose2 map_from_base;
  /// Of (x, y, yaw), map frame [m, rad]; by the walls that match.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
  double score = 0;
  int matched = 0;      ///< pieces of wall that lie on the plan's
  double spread_m = 0;  ///< how far from it places explain the drive nearly as well

  /// Whether its walls hold it in every direction.
  bool IsHeld() const;
  /// Whether it is one place besides, and not a stretch along which places are nearly as good.
  bool IsPoint() const;
};

/// All places on the plan, in every direction, that explain a drive: those no worse than the best by the
/// margin. Markov localisation (Fox, Burgard, Thrun, "Markov Localization for Mobile Robots in Dynamic
/// Environments", 1999) over a grid of all poses, which leaves out none: that only one remains is a statement
/// about all others. Best first; none when not even the best is better than "none of it is on the plan" by
/// the margin, or so many are that nothing is known yet.
std::vector<PlaceCandidate> FindPlaces(const PlaceSearchConfig& config, const PlacePlan& plan,
                                       const DrivenWay& way);

}  // namespace priamos::planner
