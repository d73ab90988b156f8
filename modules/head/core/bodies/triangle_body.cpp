#include "head/core/bodies/triangle_body.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

namespace priamos::head {
namespace {

constexpr double kSamePoint = 1e-5;  ///< of the extent
constexpr double kFlat = 0.99996;    ///< cosine of half a degree

using Triangle = std::array<int, 3>;
using HalfEdge = std::array<int, 2>;

double ExtentOf(const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : points) box.extend(p);
  return box.sizes().norm();
}

/// Points that are one get one number: those of one cell of a grid, whose cells are far smaller than a body.
class Welder {
 public:
  explicit Welder(double cell_m) : cell_m_(cell_m) {}

  int Weld(const Eigen::Vector3d& p) {
    const std::array<std::int64_t, 3> home{CellOf(p.x()), CellOf(p.y()), CellOf(p.z())};
    for (int i = 0; i < 27; ++i) {
      const auto found = known_.find({home[0] + i % 3 - 1, home[1] + i / 3 % 3 - 1, home[2] + i / 9 - 1});
      if (found != known_.end() && (points_[found->second] - p).norm() <= cell_m_) return found->second;
    }
    points_.push_back(p);
    return known_[home] = static_cast<int>(points_.size()) - 1;
  }
  const std::vector<Eigen::Vector3d>& points() const { return points_; }

 private:
  std::int64_t CellOf(double v) const { return std::llround(v / cell_m_); }

  double cell_m_;
  std::map<std::array<std::int64_t, 3>, int> known_;
  std::vector<Eigen::Vector3d> points_;
};

bool HasArea(const std::vector<Eigen::Vector3d>& points, const Triangle& t) {
  const Eigen::Vector3d u = points[t[1]] - points[t[0]], v = points[t[2]] - points[t[0]];
  return u.cross(v).norm() > kSamePoint * u.norm() * v.norm();
}

/// The mesh with every point once, without triangles that have no area.
TriangleMesh Welded(const TriangleMesh& mesh) {
  Welder welder(kSamePoint * ExtentOf(mesh.points));
  TriangleMesh welded;
  for (const Triangle& t : mesh.triangles) {
    const Triangle w{welder.Weld(mesh.points[t[0]]), welder.Weld(mesh.points[t[1]]),
                     welder.Weld(mesh.points[t[2]])};
    if (HasArea(welder.points(), w)) welded.triangles.push_back(w);
  }
  welded.points = welder.points();
  return welded;
}

Eigen::Vector3d NormalOf(const TriangleMesh& mesh, const Triangle& t) {
  const Eigen::Vector3d &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
  return (b - a).cross(c - a).normalized();
}

/// For each triangle the number of its face: triangles that hang together and are level with the first one.
std::vector<int> FaceNumbers(const TriangleMesh& mesh) {
  std::map<HalfEdge, int> owner;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i)
      owner[{mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]}] = static_cast<int>(t);
  std::vector<int> numbers(mesh.triangles.size(), -1);
  int n_faces = 0;
  for (std::size_t first = 0; first < numbers.size(); ++first) {
    if (numbers[first] >= 0) continue;
    const Eigen::Vector3d normal = NormalOf(mesh, mesh.triangles[first]);
    std::vector<int> open{static_cast<int>(first)};
    numbers[first] = n_faces;
    while (!open.empty()) {
      const Triangle& t = mesh.triangles[open.back()];
      open.pop_back();
      for (int i = 0; i < 3; ++i) {
        const auto next = owner.find({t[(i + 1) % 3], t[i]});
        if (next == owner.end() || numbers[next->second] >= 0) continue;
        if (NormalOf(mesh, mesh.triangles[next->second]).dot(normal) < kFlat) continue;
        numbers[next->second] = n_faces;
        open.push_back(next->second);
      }
    }
    ++n_faces;
  }
  return numbers;
}

/// The outline of triangles that are one face, as one loop; nullopt if there are several, as around a hole.
std::optional<std::vector<int>> OutlineOf(const std::vector<Triangle>& triangles) {
  std::map<HalfEdge, int> halves;
  for (const Triangle& t : triangles)
    for (int i = 0; i < 3; ++i) ++halves[{t[i], t[(i + 1) % 3]}];
  std::map<int, int> next;
  for (const auto& [edge, n] : halves) {
    if (halves.contains({edge[1], edge[0]})) continue;
    if (n != 1 || !next.emplace(edge[0], edge[1]).second) return std::nullopt;
  }
  if (next.empty()) return std::nullopt;
  std::vector<int> loop{next.begin()->first};
  while (loop.size() <= next.size()) {
    const auto step = next.find(loop.back());
    if (step == next.end()) return std::nullopt;
    if (step->second == loop.front()) break;
    loop.push_back(step->second);
  }
  if (loop.size() != next.size()) return std::nullopt;
  return loop;
}

/// Points in the middle of a straight edge go, where all faces that have them agree: an edge in pieces would
/// be several edges of the model.
void DropMiddlePoints(Polyhedron& body) {
  std::map<int, std::vector<int>> neighbours;
  for (const auto& face : body.faces)
    for (std::size_t i = 0; i < face.size(); ++i)
      for (const int other : {face[(i + 1) % face.size()], face[(i + face.size() - 1) % face.size()]}) {
        auto& list = neighbours[face[i]];
        if (std::ranges::find(list, other) == list.end()) list.push_back(other);
      }
  const auto is_middle = [&](int p) {
    const auto& list = neighbours[p];
    if (list.size() != 2) return false;
    const Eigen::Vector3d a = (body.points[p] - body.points[list[0]]).normalized();
    const Eigen::Vector3d b = (body.points[list[1]] - body.points[p]).normalized();
    return a.dot(b) > kFlat;
  };
  for (auto& face : body.faces) {
    std::vector<int> kept;
    std::ranges::copy_if(face, std::back_inserter(kept), [&](int p) { return !is_middle(p); });
    if (kept.size() >= 3) face = std::move(kept);
  }
}

std::optional<Refusal> CheckMesh(const TriangleMesh& mesh) {
  const int n = static_cast<int>(mesh.points.size());
  if (mesh.triangles.empty()) return Refusal{"expected triangles, got none"};
  for (const Eigen::Vector3d& p : mesh.points)
    if (!p.allFinite() || p.cwiseAbs().maxCoeff() > 1e6)
      return Refusal{"expected coordinates from -1e6 to 1e6, got others"};
  for (const Triangle& t : mesh.triangles)
    for (const int i : t)
      if (i < 0 || i >= n)
        return Refusal{fmt::format("a triangle: expected points 0 to {}, got {}", n - 1, i)};
  return std::nullopt;
}

}  // namespace

Outcome<Polyhedron> BodyOfTriangles(const TriangleMesh& raw) {
  if (auto refusal = CheckMesh(raw)) return *refusal;
  TriangleMesh mesh = Welded(raw);
  OrientTriangles(mesh);
  const std::vector<int> numbers = FaceNumbers(mesh);
  std::map<int, std::vector<Triangle>> triangles_of;
  for (std::size_t t = 0; t < numbers.size(); ++t) triangles_of[numbers[t]].push_back(mesh.triangles[t]);
  Polyhedron body;
  body.points = mesh.points;
  for (const auto& [face, triangles] : triangles_of) {
    if (auto outline = OutlineOf(triangles))
      body.faces.push_back(std::move(*outline));
    else
      for (const Triangle& t : triangles) body.faces.emplace_back(t.begin(), t.end());
    if (body.faces.size() > kMaxFlatFaces)
      return Refusal{
          fmt::format("expected a body of at most {} flat faces, got a rounder one", kMaxFlatFaces)};
  }
  DropMiddlePoints(body);
  if (auto refusal = CheckPolyhedron(body)) return *refusal;
  return body;
}

}  // namespace priamos::head
