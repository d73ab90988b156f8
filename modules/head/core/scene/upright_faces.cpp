#include "head/core/scene/upright_faces.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "head/core/camera/projection.hpp"
#include "head/core/doors/line_cover.hpp"
#include "head/core/scene/face_sights.hpp"

namespace priamos::head {
namespace {

constexpr double kLevel = 0.05;  ///< |z| of the unit normal of a line's plane: below it an upright
constexpr double kSameHeight_m = 0.015;
constexpr double kBeside_px = 3;

class FaceSearch {
 public:
  FaceSearch(const StereoViews& views, std::span<const UprightEdge> uprights, const FaceOptions& options)
      : views_(views), uprights_(uprights), options_(options) {
    for (std::size_t c = 0; c < views.size(); ++c)
      for (const ViewLine& line : views[c].lines)
        if (std::abs(line.plane.z()) > kLevel) level_[c].push_back(&line);
  }

  /// The face between two upright edges, if there is one.
  std::optional<UprightFace> Between(int i, int j) const {
    UprightFace face = InOrder(i, j);
    if (face.width_m < options_.min_width_m || face.width_m > options_.max_width_m) return std::nullopt;
    const UprightEdge &a = uprights_[face.left], &b = uprights_[face.right];
    const double low = std::max(a.bottom_m, b.bottom_m), high = std::min(a.top_m, b.top_m);
    if (high - low < options_.min_height_m) return std::nullopt;
    const auto top = LevelAt(a, b, a.top_m, b.top_m), bottom = LevelAt(a, b, a.bottom_m, b.bottom_m);
    if (!top && !bottom) return std::nullopt;
    face.n_levels = (top ? 1 : 0) + (bottom ? 1 : 0);
    face.top_m = top ? *top : high;
    face.bottom_m = bottom ? *bottom : std::min(a.bottom_m, b.bottom_m);
    if (face.bottom_m < options_.on_floor_m) face.bottom_m = 0;
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

  /// Metres per pixel at an upright edge, in the left image.
  double Scale_m(const UprightEdge& edge, double z) const {
    const Eigen::Vector3d low(edge.at.x(), edge.at.y(), z);
    const CameraModel& camera = *views_[0].camera;
    return 0.1 / std::max(1e-6, (camera.Project(low + Eigen::Vector3d(0, 0, 0.1)) - camera.Project(low)).norm());
  }

  /// Height of a level edge that joins two ends, each at its height.
  std::optional<double> LevelAt(const UprightEdge& a, const UprightEdge& b, double end_a, double end_b) const {
    const double near_a = options_.corner_m + options_.corner_px * Scale_m(a, end_a),
                 near_b = options_.corner_m + options_.corner_px * Scale_m(b, end_b);
    std::optional<double> best;
    double most = options_.min_cover, last = 1e9;
    for (const auto& level : level_) {
      for (const ViewLine* line : level) {
        const double za = HeightOn(*line, a.at), zb = HeightOn(*line, b.at), z = (za + zb) / 2;
        if (std::abs(za - zb) > options_.level_m || std::abs(z - end_a) > near_a || std::abs(z - end_b) > near_b)
          continue;
        if (std::abs(z - last) < kSameHeight_m / 4) continue;
        last = z;
        const double cover = std::min(CoverIn(views_[0], a.at, b.at, z), CoverIn(views_[1], a.at, b.at, z));
        if (cover < most || (best && cover <= most)) continue;
        most = cover;
        best = z;
      }
    }
    return best;
  }

  double CoverIn(const CameraView& view, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double z) const {
    const Eigen::Vector3d from(a.x(), a.y(), z), to(b.x(), b.y(), z);
    if (view.camera->Depth(from) <= 0 || view.camera->Depth(to) <= 0) return 0;
    const ExpectedLine expected(view.camera->Project(from), view.camera->Project(to));
    if (expected.length_px < options_.min_width_px) return 0;
    return CoverOfAnyContrast(view, expected, kBeside_px).share;
  }

  const StereoViews& views_;
  std::span<const UprightEdge> uprights_;
  const FaceOptions& options_;
  std::array<std::vector<const ViewLine*>, 2> level_;
};

/// Whether `inner` lies on the plane of `outer` and within it.
bool IsWithin(const UprightFace& inner, const UprightFace& outer, std::span<const UprightEdge> uprights,
              const FaceOptions& options) {
  const Eigen::Vector2d origin = uprights[outer.left].at;
  const Eigen::Vector2d along = (uprights[outer.right].at - origin) / outer.width_m, across(-along.y(), along.x());
  for (const int end : {inner.left, inner.right}) {
    const Eigen::Vector2d off = uprights[end].at - origin;
    const double sigma = std::sqrt(across.dot(uprights[end].covariance * across));
    if (std::abs(across.dot(off)) > options.plane_m + 3 * sigma) return false;
    if (along.dot(off) < -options.plane_m || along.dot(off) > outer.width_m + options.plane_m) return false;
  }
  return inner.top_m < outer.top_m + options.plane_m && inner.bottom_m > outer.bottom_m - options.plane_m;
}

double AreaOf(const UprightFace& face) {
  return face.width_m * (face.top_m - face.bottom_m);
}

}  // namespace

std::vector<UprightFace> FindFaces(const StereoViews& views, std::span<const StereoMatch> matches,
                                   std::span<const UprightEdge> uprights, const FaceOptions& options) {
  const FaceSearch search(views, uprights, options);
  std::vector<UprightFace> candidates;
  for (int i = 0; i < static_cast<int>(uprights.size()); ++i)
    for (int j = 0; j < i; ++j)
      if (const auto face = search.Between(i, j)) candidates.push_back(*face);
  std::stable_sort(candidates.begin(), candidates.end(), [](const UprightFace& a, const UprightFace& b) {
    return std::pair(a.n_levels, AreaOf(a)) > std::pair(b.n_levels, AreaOf(b));
  });
  std::vector<UprightFace> faces;
  for (const UprightFace& face : candidates) {
    const bool known = std::any_of(faces.begin(), faces.end(), [&](const UprightFace& outer) {
      return IsWithin(face, outer, uprights, options);
    });
    if (known) continue;
    const FacePlane plane(uprights[face.left].at, uprights[face.right].at, face.bottom_m, face.top_m);
    if (!IsSeenThrough(plane, views[0], matches, options.behind_m)) faces.push_back(face);
  }
  return faces;
}

}  // namespace priamos::head
