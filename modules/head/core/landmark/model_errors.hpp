#pragma once

#include <Eigen/Core>
#include <vector>

#include "head/core/landmark/landmark.hpp"

namespace priamos::head {

/// How far each edge of a model lies off its place there, landmark frame [m].
using EdgeShifts = std::vector<Eigen::Vector3d>;

/// How much broader a landmark is than its model, and how well that is known [m].
struct Breadth {
  double broader_m = 0;
  double sigma_m = 0;
};

/// Whether two edges that do not move lie in one upright plane square to x.
bool AreInOneDepth(const LandmarkEdge& a, const LandmarkEdge& b);

/// What looks showed of the errors of a model, landmark frame [m]: of every edge its own shift (x, y, z), and
/// last how much broader the landmark is. The covariance has what the looks could not tell: a shift of all
/// edges alike is one of the landmark.
struct ModelErrors {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;

  static Eigen::Index SizeFor(const LandmarkModel& model) {
    return static_cast<Eigen::Index>(3 * model.edges.size() + 1);
  }
  Breadth breadth() const;
  bool empty() const { return mean.size() == 0; }
};

/// Where the edges of the model lie for errors in the order of ModelErrors, the breadth included.
EdgeShifts ShiftsOf(const LandmarkModel& model, const Eigen::VectorXd& errors);

/// The model with its edges shifted.
LandmarkModel Shifted(LandmarkModel model, const EdgeShifts& shifts);

/// Variances of the errors that models have before any look: of each edge by itself, of one that moves, of
/// the breadth, of the height, which lifts all that is level by its share of it, and of the depth, which
/// moves all edges of one upright plane square to x together: how far a frame stands out from the wall is one
/// number of a plan, not one of each edge.
struct ModelVariance {
  double edge_m2 = 0, movable_m2 = 0, breadth_m2 = 0, height_m2 = 0, depth_m2 = 0;

  /// In the order of ModelErrors.
  Eigen::MatrixXd CovarianceFor(const LandmarkModel& model) const;
};

/// What still holds at the next look: a movable edge may have been moved, and what all looks err alike, by
/// their cameras and by the light, is not known better for many of them.
ModelErrors CarriedOver(ModelErrors errors, const LandmarkModel& model, const ModelVariance& before);

/// Of errors only the breadth, which many edges show; the edges are as uncertain as before any look. Empty
/// for errors that are, or are of another model.
ModelErrors OnlyBreadth(const ModelErrors& errors, const LandmarkModel& model, const ModelVariance& before);

}  // namespace priamos::head
