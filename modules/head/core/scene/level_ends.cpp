#include "head/core/scene/level_ends.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "head/core/camera/projection.hpp"
#include "head/core/scene/face_cover.hpp"
#include "head/core/stereo/plan_line.hpp"

namespace priamos::head {
namespace {

constexpr double kMoreUncertain = 2;  ///< variance of the place that a level edge leads to

class LevelEndSearch {
 public:
  LevelEndSearch(const StereoViews& views, const UprightOptions& same, const LevelEndOptions& options,
                 std::vector<UprightEdge>& uprights)
      : views_(views), same_(same), options_(options), uprights_(uprights) {}

  void Run() {
    const std::size_t known = uprights_.size();
    for (std::size_t i = 0; i < known; ++i)
      for (const CameraView& view : views_)
        for (const ViewLine& line : view.lines)
          if (IsLevel(line) && line.length_px > options_.min_level_px) Follow(uprights_[i], view, line);
  }

 private:
  /// A level edge that begins at the upper end of `edge` in this image.
  void Follow(UprightEdge edge, const CameraView& view, const ViewLine& level) {
    const double z = HeightOn(level, edge.at);
    if (std::abs(z - OpticalCentre(*view.camera).z()) < options_.eye_level_m) return;
    const Eigen::Vector3d corner(edge.at.x(), edge.at.y(), z), end(edge.at.x(), edge.at.y(), edge.top_m);
    if (view.camera->Depth(corner) <= 0 || z <= edge.bottom_m) return;
    const Eigen::Vector2d at = view.camera->Project(corner);
    if ((at - view.camera->Project(end)).norm() > options_.corner_px) return;
    const double p = (level.p - at).norm(), q = (level.q - at).norm();
    if (std::min(p, q) > options_.corner_px) return;
    LookBelow(edge, view, level, z, p > q ? level.p : level.q);
  }

  /// Upright lines that pass the other end, in this image.
  void LookBelow(const UprightEdge& edge, const CameraView& view, const ViewLine& level, double z,
                 const Eigen::Vector2d& end) {
    for (const ViewLine& line : view.lines) {
      if (IsLevel(line)) continue;
      const auto at = Crossing(PlanLine(level, z), PlanLine(line, z));
      if (!at || at->x() < 0) continue;
      const Eigen::Vector3d corner(at->x(), at->y(), z);
      if (view.camera->Depth(corner) <= 0 || (view.camera->Project(corner) - end).norm() > options_.corner_px)
        continue;
      Add({*at, kMoreUncertain * edge.covariance, edge.bottom_m, z});
    }
  }

  void Add(const UprightEdge& edge) {
    const Eigen::Vector3d low(edge.at.x(), edge.at.y(), edge.bottom_m),
        high(edge.at.x(), edge.at.y(), edge.top_m);
    const bool known = std::any_of(uprights_.begin(), uprights_.end(), [&](const UprightEdge& other) {
      return AreOne(other, edge, same_) && other.top_m > edge.top_m - same_.gap_m;
    });
    if (known || CoverInBoth(views_, low, high) < options_.min_cover) return;
    uprights_.push_back(edge);
  }

  const StereoViews& views_;
  const UprightOptions& same_;
  const LevelEndOptions& options_;
  std::vector<UprightEdge>& uprights_;
};

}  // namespace

void AddUprightsAtLevelEnds(const StereoViews& views, const UprightOptions& same,
                            const LevelEndOptions& options, std::vector<UprightEdge>& uprights) {
  LevelEndSearch(views, same, options, uprights).Run();
}

}  // namespace priamos::head
