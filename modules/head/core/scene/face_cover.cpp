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
  bool is_cut_first = false, is_cut_last = false;  ///< it goes on beyond the picture, or ends near its border
};

bool IsCut(const ImageSize& size, const Eigen::Vector2d& at, bool is_end) {
  constexpr double kBorder_px = 12;
  const double beside = std::min({at.x(), at.y(), size.width - 1 - at.x(), size.height - 1 - at.y()});
  return !is_end || beside < kBorder_px;
}

/// nullopt: too little of it lies in the picture.
std::optional<SeenEdge> SeeIn(const CameraView& view, const Eigen::Vector3d& from,
                              const Eigen::Vector3d& to) {
  const auto edge = ProjectEdge(*view.camera, view.size, from, to);
  if (!edge || edge->length_px() < kShortest_px) return std::nullopt;
  return SeenEdge{CoverOfAnyContrast(view, ExpectedLine(edge->p, edge->q), kBeside_px), edge->length_px(),
                  IsCut(view.size, edge->p, edge->p_is_end), IsCut(view.size, edge->q, edge->q_is_end)};
}

}  // namespace

double CoverIn(const CameraView& view, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const auto seen = SeeIn(view, from, to);
  return seen ? seen->cover.share : 0;
}

double CoverInBoth(const StereoViews& views, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  double least = 1;
  for (const CameraView& view : views) least = std::min(least, CoverIn(view, from, to));
  return least;
}

bool EndsIn(const CameraView& view, const Eigen::Vector3d& from, const Eigen::Vector3d& to, EndRule rule,
            const EndTolerance& tolerance) {
  const auto seen = SeeIn(view, from, to);
  if (!seen || seen->cover.line < 0) return false;
  const double by_px = std::max(tolerance.px, tolerance.share * seen->length_px);
  const double first_px = seen->is_cut_first ? std::max(by_px, tolerance.cut_px) : by_px,
               last_px = seen->is_cut_last ? std::max(by_px, tolerance.cut_px) : by_px;
  const Cover& cover = seen->cover;
  if (cover.first_px > first_px || cover.last_px < -last_px) return false;
  return rule == EndRule::kReach || (cover.first_px > -first_px && cover.last_px < last_px);
}

bool EndsInBoth(const StereoViews& views, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                EndRule rule, const EndTolerance& tolerance) {
  return std::all_of(views.begin(), views.end(),
                     [&](const CameraView& view) { return EndsIn(view, from, to, rule, tolerance); });
}

}  // namespace priamos::head
