#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace priamos::head {

/// A body as triangles, counter-clockwise seen from outside: what a mesh file holds.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> points;  ///< [m]
  std::vector<std::array<int, 3>> triangles;
};

/// Turns triangles of a mesh whose points are shared (one number each) so that neighbours agree on what is
/// outside, as most of their area has it; where they enclose something, the outside is outside. Many programs
/// write files that are turned inside out, or half of them.
void OrientTriangles(TriangleMesh& mesh);

}  // namespace priamos::head
