#pragma once

#include "common/outcome.hpp"
#include "head/core/bodies/polyhedron.hpp"
#include "head/core/bodies/triangle_mesh.hpp"

namespace priamos::head {

/// How many flat faces a body may have: its edges are compared with its faces at every pose that is tried.
constexpr std::size_t kMaxFlatFaces = 300;

/// The flat faces of a mesh, which is turned as OrientTriangles does. Points closer than 1e-5 of its extent
/// are one; triangles that share an edge and are level within half a degree are one face, unless the face has
/// a hole: then its triangles stay, and VisibleSkeleton sees no edges between them. Refuses a mesh without
/// triangles, numbers of points that are not there, numbers that are not finite, and a body that is round:
/// more than kMaxFlatFaces.
Outcome<Polyhedron> BodyOfTriangles(const TriangleMesh& mesh);

}  // namespace priamos::head
