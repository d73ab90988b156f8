#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "common/outcome.hpp"
#include "head/core/landmark/landmark.hpp"

namespace priamos::head {

/// A body of flat faces: a free landmark model, whose visible edges follow from its geometry.
struct Polyhedron {
  std::vector<Eigen::Vector3d> points;  ///< landmark frame [m]
  /// Corners of each face, counter-clockwise seen from outside; a face hides what lies behind it from both of
  /// its sides, but its own edges are seen from outside only.
  std::vector<std::vector<int>> faces;
  /// Brightness of each face relative to the others under even light; 0: not known. Empty: none is known.
  std::vector<double> greys;
  /// Further edges, seen from everywhere unless a face is before them.
  std::vector<std::array<int, 2>> lines;
};

/// What is wrong with the body, nullopt if nothing: a face of fewer than 3 corners or not flat to 1 % of
/// its size, a number of a point that is not there, numbers that are not finite, nothing at all.
std::optional<Refusal> CheckPolyhedron(const Polyhedron& body);

/// What an eye at `eye_m` (landmark frame) sees of the edges: those of faces that look at it, cut where other
/// faces are before them; none between two faces that are level within a degree and of one grey. Pieces
/// shorter than `min_m` are left out. Between two faces that are both seen, and whose greys are known, the
/// ratio of grey values is known; behind an outline the background is unknown.
LandmarkModel VisibleSkeleton(const Polyhedron& body, const Eigen::Vector3d& eye_m, double min_m = 0.002);

}  // namespace priamos::head
