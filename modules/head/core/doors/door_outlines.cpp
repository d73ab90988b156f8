#include "head/core/doors/door_outlines.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "head/core/doors/line_cover.hpp"
#include "head/core/stereo/plan_line.hpp"

namespace priamos::head {
namespace {

constexpr double kLeastRise = 0.03;      ///< lintels at the height of the camera have no distance
constexpr double kPictureBorder_px = 8;  ///< what ends here may go on outside of the picture
constexpr double kCornerInside_px = 2;   ///< corners out of the picture are none
constexpr double kCornerShare = 0.35;    ///< of an upright's length: its end may be so far from the corner
constexpr double kCornerReach_px = 20;   ///< or so far
constexpr double kSameUpright_px = 1.5;  ///< pieces of one upright lie so near to one line

struct Upright {
  int line = 0;
  Eigen::Vector2d bearing;
  Eigen::Vector2d top, bottom;  ///< [px]
};

/// Where an upright crosses the line of a lintel.
struct Crossed {
  const Upright* upright = nullptr;
  double along_px = 0, rise = 0;
  Eigen::Vector2d corner;
};

class OutlineFinder {
 public:
  OutlineFinder(const CameraView& view, const OutlineOptions& options)
      : view_(view), options_(options), rays_(view.camera->image_from_base.leftCols<3>().inverse()) {
    for (std::size_t i = 0; i < view.lines.size(); ++i)
      if (const auto upright = AsUpright(static_cast<int>(i))) uprights_.push_back(*upright);
  }

  std::vector<DoorOutline> Run() {
    for (std::size_t i = 0; i < view_.lines.size(); ++i)
      if (IsLevel(view_.lines[i])) Follow(static_cast<int>(i));
    return std::move(outlines_);
  }

 private:
  Eigen::Vector3d Ray(const Eigen::Vector2d& px) const { return rays_ * px.homogeneous(); }

  std::optional<Upright> AsUpright(int index) const {
    const ViewLine& line = view_.lines[index];
    const double noise = view_.edges->segments[line.segment].sigma_angle_rad;
    if (line.length_px < options_.min_upright_px) return std::nullopt;
    if (std::abs(line.plane.z()) > options_.max_lean_rad + 3 * noise) return std::nullopt;
    const Eigen::Vector2d middle = (line.p + line.q) / 2;
    const Eigen::Vector3d ray = Ray(middle);
    Upright upright{index, ray.head<2>().normalized(), line.p, line.q};
    if (Ray(line.p).z() < Ray(line.q).z()) std::swap(upright.top, upright.bottom);
    return upright;
  }

  std::optional<Crossed> Cross(const Upright& upright, const ViewLine& lintel,
                               const Eigen::Vector2d& direction) const {
    const double rise = -lintel.plane.head<2>().dot(upright.bearing) / lintel.plane.z();
    if (!(rise > kLeastRise && rise < 5)) return std::nullopt;
    const Eigen::Vector3d image = view_.camera->image_from_base.leftCols<3>() *
                                  Eigen::Vector3d(upright.bearing.x(), upright.bearing.y(), rise);
    if (image.z() <= 0) return std::nullopt;
    const Eigen::Vector2d corner = image.hnormalized();
    if (corner.x() < kCornerInside_px || corner.y() < kCornerInside_px ||
        corner.x() > view_.size.width - 1 - kCornerInside_px || corner.y() > view_.size.height - 1)
      return std::nullopt;
    const double reach = std::max(kCornerReach_px, kCornerShare * (upright.top - upright.bottom).norm());
    const Eigen::Vector2d down = (upright.bottom - upright.top).normalized();
    if (std::abs(down.dot(upright.top - corner)) > reach || down.dot(upright.bottom - corner) < reach / 2)
      return std::nullopt;
    return Crossed{&upright, direction.dot(corner - lintel.p), rise, corner};
  }

  void Follow(int index) {
    const ViewLine& lintel = view_.lines[index];
    const Eigen::Vector2d direction = (lintel.q - lintel.p) / lintel.length_px;
    std::vector<Crossed> crossings;
    for (const Upright& upright : uprights_)
      if (const auto crossing = Cross(upright, lintel, direction)) crossings.push_back(*crossing);
    std::sort(crossings.begin(), crossings.end(),
              [](const Crossed& a, const Crossed& b) { return a.along_px < b.along_px; });
    for (std::size_t i = 0; i < crossings.size(); ++i)
      for (std::size_t j = i + 1; j < crossings.size(); ++j)
        Consider(index, lintel.length_px, crossings[i], crossings[j]);
  }

  void Consider(int lintel, double length_px, const Crossed& a, const Crossed& b) {
    const double span = b.along_px - a.along_px;
    if (span < options_.min_width_px) return;
    const double covered = std::min(b.along_px, length_px) - std::max(a.along_px, 0.0);
    if (covered < options_.min_span_share * span) return;
    const Eigen::Vector2d &p = a.upright->bearing, &q = b.upright->bearing;
    const bool a_is_left = p.x() * q.y() - p.y() * q.x() < 0;
    const Crossed &left = a_is_left ? a : b, &right = a_is_left ? b : a;
    DoorOutline outline;
    outline.lintel = lintel;
    outline.lintel_share = covered / span;
    for (int side = 0; side < 2; ++side) {
      const Crossed& c = side == 0 ? left : right;
      outline.uprights[side] = c.upright->line;
      outline.bearings[side] = c.upright->bearing;
      outline.rises[side] = c.rise;
      outline.corners[side] = c.corner;
    }
    if (outline.width() < options_.min_width || outline.width() > options_.max_width) return;
    for (int side = 0; side < 2; ++side) FindFoot(side, outline);
    outlines_.push_back(outline);
  }

  /// Down from the corner as far as edges cover the upright.
  void FindFoot(int side, DoorOutline& outline) const {
    const Eigen::Vector2d& b = outline.bearings[side];
    const auto image = [&](double z) -> Eigen::Vector2d {
      return (view_.camera->image_from_base.leftCols<3>() * Eigen::Vector3d(b.x(), b.y(), z)).hnormalized();
    };
    const Eigen::Vector2d corner = outline.corners[side], down = (image(-0.3) - corner).normalized();
    double reach = 4000;
    const Eigen::Vector2d high(view_.size.width - 1, view_.size.height - 1);
    for (int axis = 0; axis < 2; ++axis) {
      if (down[axis] > 1e-9) reach = std::min(reach, (high[axis] - corner[axis]) / down[axis]);
      if (down[axis] < -1e-9) reach = std::min(reach, -corner[axis] / down[axis]);
    }
    if (reach < 2) return;
    const ExpectedLine expected(corner, corner + reach * down);
    const Cover cover = CoverOf(view_, expected, kSameUpright_px);
    const double length = std::clamp(reach + cover.last_px, 1.0, reach);
    outline.covered[side] = std::min(1.0, cover.share * reach / length);
    outline.first_px[side] = cover.first_px;
    outline.foot_inside[side] = cover.line >= 0 && length < reach - kPictureBorder_px;
    const Eigen::Vector3d ray = Ray(corner + length * down);
    outline.falls[side] = -ray.z() / ray.head<2>().norm();
  }

  const CameraView& view_;
  const OutlineOptions& options_;
  Eigen::Matrix3d rays_;
  std::vector<Upright> uprights_;
  std::vector<DoorOutline> outlines_;
};

}  // namespace

std::vector<DoorOutline> FindOutlines(const CameraView& level_view, const OutlineOptions& options) {
  return OutlineFinder(level_view, options).Run();
}

}  // namespace priamos::head
