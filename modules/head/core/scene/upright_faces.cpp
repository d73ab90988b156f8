#include "head/core/scene/upright_faces.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "head/core/scene/face_sights.hpp"
#include "head/core/stereo/plan_line.hpp"

namespace priamos::head {
namespace {

constexpr double kQualityCounts = 4;     ///< how much more than the area of a face
constexpr double kSameHeight_m = 0.004;  ///< level edges whose heights differ by less are tried once

Eigen::Vector3d Above(const UprightEdge& edge, double z) {
  return {edge.at.x(), edge.at.y(), z};
}

class FaceSearch {
 public:
  FaceSearch(const StereoViews& views, std::span<const UprightEdge> uprights, const FaceOptions& options)
      : views_(views), uprights_(uprights), options_(options) {
    for (const CameraView& view : views)
      for (const ViewLine& line : view.lines)
        if (IsLevel(line)) level_.push_back(&line);
  }

  /// The face between two upright edges, if there is one.
  std::optional<UprightFace> Between(int i, int j) const {
    UprightFace face = InOrder(i, j);
    if (face.width_m < options_.min_width_m || face.width_m > options_.max_width_m) return std::nullopt;
    const UprightEdge &a = uprights_[face.left], &b = uprights_[face.right];
    const double low = std::max(a.bottom_m, b.bottom_m);
    if (std::min(a.top_m, b.top_m) - low < options_.min_height_m / 2) return std::nullopt;
    const auto top = BestLevel(a, b, [&](double z) { return IsTop(a, b, low, z); });
    if (!top) return std::nullopt;
    const auto bottom = BestLevel(a, b, [&](double z) { return Joins(a, b, a.bottom_m, b.bottom_m, z); });
    face.top_m = *top;
    face.bottom_m = bottom ? *bottom : std::min(a.bottom_m, b.bottom_m);
    if (face.bottom_m < options_.on_floor_m) face.bottom_m = 0;
    face.quality = (CoverInBoth(views_, Above(a, *top), Above(b, *top)) + SidesSeen(a, b, low, *top)) / 3;
    if (face.quality < options_.min_quality) return std::nullopt;
    return face;
  }

 private:
  /// Left is what a robot at the origin has on its left hand.
  UprightFace InOrder(int i, int j) const {
    const Eigen::Vector2d &a = uprights_[i].at, &b = uprights_[j].at;
    UprightFace face;
    const bool first_is_left = a.x() * b.y() - a.y() * b.x() < 0;
    face.left = first_is_left ? i : j;
    face.right = first_is_left ? j : i;
    face.width_m = (a - b).norm();
    return face;
  }

  /// Largest distance of the end of an upright edge from a level one, at that height.
  double Near_m(const UprightEdge& edge, double z) const {
    const CameraModel& camera = *views_[0].camera;
    const double px = (camera.Project(Above(edge, z + 0.1)) - camera.Project(Above(edge, z))).norm();
    return options_.corner_m + options_.corner_px * 0.1 / std::max(1e-6, px);
  }

  /// Whether two upright edges end at a height.
  bool Joins(const UprightEdge& a, const UprightEdge& b, double end_a, double end_b, double z) const {
    return std::abs(z - end_a) < Near_m(a, end_a) && std::abs(z - end_b) < Near_m(b, end_b);
  }

  /// Both upright edges are seen up to the top and not beyond, and the level one between them in part; or the
  /// level one is seen from end to end, and upright ones in part.
  bool IsTop(const UprightEdge& a, const UprightEdge& b, double low, double z) const {
    if (z - low < options_.min_height_m || a.top_m > z + Near_m(a, z) || b.top_m > z + Near_m(b, z))
      return false;
    if (GoesOn(a, z) || GoesOn(b, z)) return false;
    if (RunsUpTo(a, low, z) && RunsUpTo(b, low, z)) return true;
    const bool joins = Joins(a, b, a.top_m, b.top_m, z);
    return EndsInBoth(views_, Above(a, z), Above(b, z), joins ? EndRule::kReach : EndRule::kStop,
                      options_.ends);
  }

  bool RunsUpTo(const UprightEdge& edge, double low, double z) const {
    const double from = std::max(low, z - options_.beyond_m);
    return CoverInBoth(views_, Above(edge, from), Above(edge, z)) > options_.min_below;
  }

  /// Whether both images show an upright edge above a height as well: what is level behind an opening seems
  /// to end at its jambs, and they go on.
  bool GoesOn(const UprightEdge& edge, double z) const {
    const double from = z + options_.beyond_m / 5, to = z + options_.beyond_m;
    return CoverInBoth(views_, Above(edge, from), Above(edge, to)) > options_.most_beyond;
  }

  double SidesSeen(const UprightEdge& a, const UprightEdge& b, double low, double z) const {
    return CoverInBoth(views_, Above(a, low), Above(a, z)) + CoverInBoth(views_, Above(b, low), Above(b, z));
  }

  /// The height of the level edge between two upright ones that is seen best, of those that are `fit`.
  template <class Fit>
  std::optional<double> BestLevel(const UprightEdge& a, const UprightEdge& b, Fit fit) const {
    std::optional<double> best;
    double most = options_.min_cover, last = 1e9;
    for (const ViewLine* line : level_) {
      const double za = HeightOn(*line, a.at), zb = HeightOn(*line, b.at), z = (za + zb) / 2;
      if (std::abs(za - zb) > options_.level_m || std::abs(z - last) < kSameHeight_m || !fit(z)) continue;
      last = z;
      const double cover = CoverInBoth(views_, Above(a, z), Above(b, z));
      if (cover < most) continue;
      most = cover;
      best = z;
    }
    return best;
  }

  const StereoViews& views_;
  std::span<const UprightEdge> uprights_;
  const FaceOptions& options_;
  std::vector<const ViewLine*> level_;
};

/// Whether `inner` lies on the plane of `outer` and within it.
bool IsWithin(const UprightFace& inner, const UprightFace& outer, std::span<const UprightEdge> uprights,
              const FaceOptions& options) {
  const Eigen::Vector2d origin = uprights[outer.left].at;
  const Eigen::Vector2d along = (uprights[outer.right].at - origin) / outer.width_m,
                        across(-along.y(), along.x());
  for (const int end : {inner.left, inner.right}) {
    const Eigen::Vector2d off = uprights[end].at - origin;
    const double sigma = std::sqrt(across.dot(uprights[end].covariance * across));
    if (std::abs(across.dot(off)) > options.plane_m + 3 * sigma) return false;
    if (along.dot(off) < -options.plane_m || along.dot(off) > outer.width_m + options.plane_m) return false;
  }
  return inner.top_m < outer.top_m + options.plane_m && inner.bottom_m > outer.bottom_m - options.plane_m;
}

double RankOf(const UprightFace& face) {
  return face.width_m * (face.top_m - face.bottom_m) * std::pow(face.quality, kQualityCounts);
}

/// The plane in which a face lies, as far as it reaches.
FacePlane PlaneOf(const UprightFace& face, std::span<const UprightEdge> uprights) {
  return {uprights[face.left].at, uprights[face.right].at, face.bottom_m, face.top_m};
}

}  // namespace

std::vector<UprightFace> FindFaces(const StereoViews& views, std::span<const SceneEdge> edges,
                                   std::span<const UprightEdge> uprights, const FaceOptions& options) {
  const FaceSearch search(views, uprights, options);
  std::vector<UprightFace> candidates;
  for (int i = 0; i < static_cast<int>(uprights.size()); ++i)
    for (int j = 0; j < i; ++j)
      if (const auto face = search.Between(i, j)) candidates.push_back(*face);
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const UprightFace& a, const UprightFace& b) { return RankOf(a) > RankOf(b); });
  std::vector<UprightFace> faces;
  for (const UprightFace& face : candidates) {
    const FacePlane plane = PlaneOf(face, uprights);
    const bool known = std::any_of(faces.begin(), faces.end(), [&](const UprightFace& other) {
      return IsWithin(face, other, uprights, options) ||
             Overlap(plane, PlaneOf(other, uprights), *views[0].camera) > options.max_overlap;
    });
    if (!known && !IsSeenThrough(plane, *views[0].camera, edges, options.behind_m)) faces.push_back(face);
  }
  return faces;
}

}  // namespace priamos::head
