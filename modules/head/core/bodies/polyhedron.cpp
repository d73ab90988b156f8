#include "head/core/bodies/polyhedron.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace priamos::head {
namespace {

constexpr int kSamples = 128;      ///< along an edge, to find where it is hidden
constexpr double kGrazing = 0.02;  ///< sine of the angle under which a face is no longer seen
constexpr double kLevel = 0.9998;  ///< cosine of a degree: two faces that meet so are one surface
constexpr double kTouching =
    1e-4;  ///< share of the distance to the eye: a face that the edge lies on hides nothing

/// A face with its plane, and its corners in that plane.
struct Face {
  Eigen::Vector3d origin, normal, u, v;
  std::vector<Eigen::Vector2d> corners;
  Eigen::Vector2d low = Eigen::Vector2d::Zero(), high = low;  ///< the rectangle about the corners
  double size = 0;
};

/// Newell's normal: exact for flat polygons, the best one for others.
Eigen::Vector3d NormalOf(const Polyhedron& body, const std::vector<int>& face) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Eigen::Vector3d &a = body.points[face[i]], &b = body.points[face[(i + 1) % face.size()]];
    normal += a.cross(b);
  }
  return normal.normalized();
}

Face MakeFace(const Polyhedron& body, const std::vector<int>& corners) {
  Face face;
  face.origin = body.points[corners[0]];
  face.normal = NormalOf(body, corners);
  face.u = face.normal.unitOrthogonal();
  face.v = face.normal.cross(face.u);
  for (const int c : corners) {
    const Eigen::Vector3d d = body.points[c] - face.origin;
    face.corners.emplace_back(face.u.dot(d), face.v.dot(d));
    face.low = face.low.cwiseMin(face.corners.back());
    face.high = face.high.cwiseMax(face.corners.back());
    face.size = std::max(face.size, d.norm());
  }
  return face;
}

/// Even-odd rule.
bool Contains(const Face& face, const Eigen::Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0, j = face.corners.size() - 1; i < face.corners.size(); j = i++) {
    const Eigen::Vector2d &a = face.corners[i], &b = face.corners[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x())
      inside = !inside;
  }
  return inside;
}

bool Looks(const Face& face, const Eigen::Vector3d& eye) {
  const Eigen::Vector3d delta = eye - face.origin;
  return face.normal.dot(delta) > kGrazing * delta.norm();
}

Eigen::Vector2d InPlane(const Face& face, const Eigen::Vector3d& from_origin) {
  return {face.u.dot(from_origin), face.v.dot(from_origin)};
}

/// A face that may hide an edge from the eye.
class Screen {
 public:
  Screen(const Face& face, const Eigen::Vector3d& eye)
      : face_(face), eye_(eye), at_eye_(face.normal.dot(eye - face.origin)) {}

  /// True if the face lies between the point and the eye, not merely at the point.
  bool Hides(const Eigen::Vector3d& point) const {
    const double at_point = face_.normal.dot(point - face_.origin);
    if (!IsBehind(at_point, 1)) return false;
    const Eigen::Vector3d hit = HitOf(point, at_point);
    return Contains(face_, {face_.u.dot(hit), face_.v.dot(hit)});
  }

  /// False if it hides nothing between two points, found without a look at those between them: none is behind
  /// its plane, or it lies beside all rays from there to the eye.
  bool MayHide(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
    const double at_from = face_.normal.dot(from - face_.origin), at_to = face_.normal.dot(to - face_.origin);
    const bool is_from_behind = IsBehind(at_from, 0.5), is_to_behind = IsBehind(at_to, 0.5);
    if (!is_from_behind && !is_to_behind) return false;
    // Rays from what is behind the plane meet it between these two places.
    const auto through = [&]() -> Eigen::Vector3d {
      return from + (to - from) * (at_from / (at_from - at_to)) - face_.origin;
    };
    const Eigen::Vector2d a = InPlane(face_, is_from_behind ? HitOf(from, at_from) : through()),
                          b = InPlane(face_, is_to_behind ? HitOf(to, at_to) : through());
    const double margin = 1e-6 * face_.size;
    return ((a.cwiseMin(b) - face_.high).array() <= margin).all() &&
           ((face_.low - a.cwiseMax(b)).array() <= margin).all();
  }

 private:
  /// Whether a point so far beside the plane lies behind it, by `share` of what makes it so, or more.
  bool IsBehind(double at_point, double share) const {
    return at_point * at_eye_ < 0 && std::abs(at_point) >= share * kTouching * std::abs(at_eye_);
  }
  /// Where the ray from there to the eye meets the plane, from the face's origin.
  Eigen::Vector3d HitOf(const Eigen::Vector3d& point, double at_point) const {
    const double share = at_point / (at_point - at_eye_);
    return point + share * (eye_ - point) - face_.origin;
  }

  const Face& face_;
  const Eigen::Vector3d& eye_;
  const double at_eye_;
};

std::vector<Face> FacesOf(const Polyhedron& body) {
  std::vector<Face> faces;
  for (const auto& corners : body.faces) faces.push_back(MakeFace(body, corners));
  return faces;
}

/// Every edge once, with the faces it borders.
std::map<std::array<int, 2>, std::vector<int>> EdgesOf(const Polyhedron& body) {
  std::map<std::array<int, 2>, std::vector<int>> edges;
  for (const auto& [a, b] : body.lines) edges[{std::min(a, b), std::max(a, b)}];
  for (std::size_t f = 0; f < body.faces.size(); ++f) {
    const auto& corners = body.faces[f];
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const int a = corners[i], b = corners[(i + 1) % corners.size()];
      edges[{std::min(a, b), std::max(a, b)}].push_back(static_cast<int>(f));
    }
  }
  return edges;
}

LandmarkEdge Everywhere(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return {from, to, -kPi, kPi, 0};
}

/// Whether the face's corners run from a to b, counter-clockwise from outside: it lies on their left hand.
bool RunsFrom(const std::vector<int>& corners, int a, int b) {
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (corners[i] == a && corners[(i + 1) % corners.size()] == b) return true;
  return false;
}

/// LandmarkEdge::grey_ratio of the edge from a to b between `borders`.
std::optional<double> GreyRatio(const Polyhedron& body, const std::vector<Face>& faces,
                                const std::vector<int>& borders, int a, int b, const Eigen::Vector3d& eye) {
  if (body.greys.empty() || borders.size() != 2) return std::nullopt;
  double left = 0, right = 0;
  for (const int f : borders) {
    if (!Looks(faces[f], eye)) return std::nullopt;
    (RunsFrom(body.faces[f], a, b) ? left : right) = body.greys[f];
  }
  if (left <= 0 || right <= 0) return std::nullopt;
  return std::log(right / left);
}

/// Whether two faces meet there that nobody can tell apart: level, and of one grey or unknown ones.
bool IsSeam(const Polyhedron& body, const std::vector<Face>& faces, const std::vector<int>& borders) {
  if (borders.size() != 2) return false;
  if (!body.greys.empty() && body.greys[borders[0]] != body.greys[borders[1]]) return false;
  return faces[borders[0]].normal.dot(faces[borders[1]].normal) > kLevel;
}

/// The parts of an edge that no face hides.
void AddVisible(const std::vector<Face>& faces, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                std::optional<double> grey_ratio, const Eigen::Vector3d& eye, double min_m,
                LandmarkModel& seen) {
  const auto at = [&](int i) -> Eigen::Vector3d { return from + (to - from) * (double(i) / kSamples); };
  std::vector<Screen> screens;
  screens.reserve(faces.size());
  for (const Face& face : faces)
    if (const Screen screen(face, eye); screen.MayHide(from, to)) screens.push_back(screen);
  int begin = -1;
  for (int i = 0; i <= kSamples + 1; ++i) {
    const bool visible = i <= kSamples && std::none_of(screens.begin(), screens.end(),
                                                       [&](const Screen& s) { return s.Hides(at(i)); });
    if (visible && begin < 0) begin = i;
    if (visible || begin < 0) continue;
    const Eigen::Vector3d a = at(begin), b = at(i - 1);
    if ((b - a).norm() >= min_m) {
      seen.edges.push_back(Everywhere(a, b));
      seen.edges.back().grey_ratio = grey_ratio;
    }
    begin = -1;
  }
}

}  // namespace

std::optional<Refusal> CheckPolyhedron(const Polyhedron& body) {
  const int n = static_cast<int>(body.points.size());
  const auto known = [n](int i) { return i >= 0 && i < n; };
  if (body.faces.empty() && body.lines.empty())
    return Refusal{"expected at least one face or line, got none"};
  for (int i = 0; i < n; ++i)
    if (!body.points[i].allFinite()) return Refusal{fmt::format("point {}: expected finite numbers", i)};
  for (const auto& line : body.lines)
    for (const int i : line)
      if (!known(i)) return Refusal{fmt::format("a line: expected points 0 to {}, got {}", n - 1, i)};
  if (!body.greys.empty() && body.greys.size() != body.faces.size())
    return Refusal{
        fmt::format("expected greys of all {} faces, got {}", body.faces.size(), body.greys.size())};
  for (const double grey : body.greys)
    if (!(grey >= 0 && grey <= 255))
      return Refusal{fmt::format("expected greys from 0 to 255, got {}", grey)};
  for (std::size_t f = 0; f < body.faces.size(); ++f) {
    const auto& face = body.faces[f];
    if (face.size() < 3)
      return Refusal{fmt::format("face {}: expected 3 corners or more, got {}", f, face.size())};
    for (const int i : face)
      if (!known(i)) return Refusal{fmt::format("face {}: expected points 0 to {}, got {}", f, n - 1, i)};
    const Face plane = MakeFace(body, face);
    if (!plane.normal.allFinite() || plane.normal.norm() < 0.5)
      return Refusal{fmt::format("face {}: expected corners that span a plane", f)};
    for (const int i : face)
      if (std::abs(plane.normal.dot(body.points[i] - plane.origin)) > 0.05 * plane.size)
        return Refusal{fmt::format("face {}: expected corners in one plane, point {} is beside it", f, i)};
  }
  return std::nullopt;
}

LandmarkModel VisibleSkeleton(const Polyhedron& body, const Eigen::Vector3d& eye_m, double min_m) {
  const std::vector<Face> faces = FacesOf(body);
  LandmarkModel seen;
  for (const auto& [ends, borders] : EdgesOf(body)) {
    const bool faces_it = borders.empty() || std::any_of(borders.begin(), borders.end(),
                                                         [&](int f) { return Looks(faces[f], eye_m); });
    if (faces_it && !IsSeam(body, faces, borders))
      AddVisible(faces, body.points[ends[0]], body.points[ends[1]],
                 GreyRatio(body, faces, borders, ends[0], ends[1], eye_m), eye_m, min_m, seen);
  }
  return seen;
}

}  // namespace priamos::head
