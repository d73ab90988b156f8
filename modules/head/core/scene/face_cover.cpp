#include "head/core/scene/face_cover.hpp"

#include <algorithm>
#include <optional>

#include "head/core/camera/projection.hpp"
#include "head/core/doors/line_cover.hpp"

namespace priamos::head {
namespace {

constexpr double kBeside_px = 3, kShortest_px = 16;

/// What one image shows of an edge, and how long it is there.
struct SeenEdge {
  Cover cover;
  double length_px = 0;
};

/// nullopt: too little of it lies in the picture.
std::optional<SeenEdge> SeeIn(const CameraView& view, const Eigen::Vector3d& from,
                              const Eigen::Vector3d& to) {
  const auto edge = ProjectEdge(*view.camera, view.size, from, to);
  if (!edge || edge->length_px() < kShortest_px) return std::nullopt;
  return SeenEdge{CoverOfAnyContrast(view, ExpectedLine(edge->p, edge->q), kBeside_px), edge->length_px()};
}

}  // namespace

double CoverInBoth(const StereoViews& views, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  double least = 1;
  for (const CameraView& view : views) {
    const auto seen = SeeIn(view, from, to);
    least = std::min(least, seen ? seen->cover.share : 0);
  }
  return least;
}

bool EndsInBoth(const StereoViews& views, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                EndRule rule, const EndTolerance& tolerance) {
  return std::all_of(views.begin(), views.end(), [&](const CameraView& view) {
    const auto seen = SeeIn(view, from, to);
    if (!seen || seen->cover.line < 0) return false;
    const double by_px = std::max(tolerance.px, tolerance.share * seen->length_px);
    const Cover& cover = seen->cover;
    if (cover.first_px > by_px || cover.last_px < -by_px) return false;
    return rule == EndRule::kReach || (cover.first_px > -by_px && cover.last_px < by_px);
  });
}

}  // namespace priamos::head
