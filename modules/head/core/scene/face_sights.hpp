#pragma once

#include <Eigen/Core>
#include <span>

#include "head/core/camera/camera_model.hpp"
#include "head/core/scene/scene_edges.hpp"

namespace priamos::head {

/// An upright rectangle of the base frame [m].
struct FacePlane {
  Eigen::Vector2d from, to;  ///< its ends on the floor
  double bottom_m, top_m;

  FacePlane(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double bottom, double top)
      : from(a), to(b), bottom_m(bottom), top_m(top) {}
};

/// Whether edges of space are seen through it: those that appear within it and lie more than `behind_m`, and
/// 3 sigmas, behind its plane outweigh those on the plane.
bool IsSeenThrough(const FacePlane& face, const CameraModel& left, std::span<const SceneEdge> edges,
                   double behind_m);

/// The share of a face that appears, in the left image, where the other one does; 0 for faces that only meet.
double Overlap(const FacePlane& face, const FacePlane& other, const CameraModel& left);

}  // namespace priamos::head
