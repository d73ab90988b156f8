#include "head/core/doors/door_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace priamos::head {
namespace {

constexpr double kBorder_px = 8;   ///< what ends here may go on outside of the picture
constexpr double kHangs_m = 0.15;  ///< skirting and threshold hide no more than that of an upright
constexpr double kSill_px = 4;
constexpr double kNearestFrame_m = 0.025, kFarthestFrame_m = 0.25;

Eigen::Vector2d Image(const CameraView& view, const Eigen::Vector2d& at, double z) {
  return view.camera->Project({at.x(), at.y(), z});
}

bool Inside(const CameraView& view, const Eigen::Vector2d& px) {
  return px.x() > kBorder_px && px.x() < view.size.width - 1 - kBorder_px && px.y() > kBorder_px &&
         px.y() < view.size.height - 1 - kBorder_px;
}

/// From the corner down as far as the picture goes.
ExpectedLine UprightIn(const CameraView& view, const Eigen::Vector2d& corner, const Eigen::Vector2d& foot) {
  const Eigen::Vector2d direction = foot - corner, low = Eigen::Vector2d::Constant(kBorder_px),
                        high(view.size.width - 1 - kBorder_px, view.size.height - 1 - kBorder_px);
  double t = 1;
  for (int axis = 0; axis < 2; ++axis) {
    if (direction[axis] > 0) t = std::min(t, (high[axis] - corner[axis]) / direction[axis]);
    if (direction[axis] < 0) t = std::min(t, (low[axis] - corner[axis]) / direction[axis]);
  }
  return {corner, corner + std::max(t, 0.05) * direction};
}

/// The best second line parallel to `e`, between two distances to its `inner` side.
double Nested(const CameraView& view, const ExpectedLine& e, const Eigen::Vector2d& inner, double near_px,
              double far_px) {
  double best = 0;
  const double side = inner.dot(e.normal) > 0 ? 1 : -1;
  for (const ViewLine& line : view.lines) {
    const Eigen::Vector2d a = line.p - e.p, b = line.q - e.p;
    const double da = side * e.normal.dot(a), db = side * e.normal.dot(b), at = (da + db) / 2;
    if (at < near_px || at > far_px || std::abs(da - db) > 0.12 * line.length_px) continue;
    const double s = e.direction.dot(a), t = e.direction.dot(b);
    const double common = std::min(std::max(s, t), e.length_px) - std::max(std::min(s, t), 0.0);
    best = std::max(best, common / e.length_px);
  }
  return best;
}

/// Linear between the given points.
double Table(double x, std::initializer_list<std::array<double, 2>> points) {
  const std::array<double, 2>* last = points.begin();
  if (x <= (*last)[0]) return (*last)[1];
  for (const auto& point : points) {
    if (x < point[0])
      return (*last)[1] + (point[1] - (*last)[1]) * (x - (*last)[0]) / (point[0] - (*last)[0]);
    last = &point;
  }
  return (*last)[1];
}

/// Log odds of an edge that ends `px` beside the corner: normally distributed for a door, evenly for others.
double OfEnd(double px, double sigma_px, double door_share, double reach_px) {
  const double normal = std::exp(-0.5 * px * px / (sigma_px * sigma_px)) / (2.507 * sigma_px);
  return std::log(door_share * normal * reach_px + 1 - door_share);
}

/// Log odds of all evidence. The tables compare doors of rendered corridors with false candidates there.
double LogOdds(const DoorEvidence& e) {
  double sum = Table(e.lintel.share, {{0.3, -4}, {0.6, -2.5}, {0.8, -1}, {0.95, 1.2}});
  sum += OfEnd(e.lintel.first_px, 2.5, 0.85, 50) + OfEnd(e.lintel.last_px, 2.5, 0.85, 50);
  for (const Cover& upright : e.uprights) {
    sum += Table(upright.share, {{0.3, -2.5}, {0.6, -2}, {0.8, -0.8}, {0.95, 1}});
    if (upright.share > 0) sum += 0.7 * OfEnd(upright.first_px, 2.5, 0.8, 50);
  }
  sum += Table(std::min(e.hangs_m[0], e.hangs_m[1]), {{0.15, 0.6}, {0.3, -1.5}, {0.5, -3.5}});
  sum += Table(std::max(e.hangs_m[0], e.hangs_m[1]), {{0.15, 0.4}, {0.3, -0.4}, {0.5, -0.8}});
  sum += Table(e.sill, {{0.3, 0}, {0.7, -8}});
  sum += Table(e.frame_lintel, {{0.2, -11}, {0.5, -1.5}, {0.7, 0.5}, {0.85, 1.5}});
  sum += Table(std::max(e.frame_uprights[0], e.frame_uprights[1]), {{0.4, -1.5}, {0.7, -0.6}, {0.9, 0.7}});
  return sum;
}

}  // namespace

DoorEvidence WeighDoor(const CameraView& view, const DoorShape& door) {
  DoorEvidence e;
  const std::array<const Eigen::Vector2d*, 2> at{&door.left, &door.right};
  std::array<Eigen::Vector2d, 2> corner, foot;
  std::array<double, 2> metre_px;  // along the uprights
  for (int i = 0; i < 2; ++i) {
    corner[i] = Image(view, *at[i], door.height_m);
    foot[i] = Image(view, *at[i], 0);
    metre_px[i] = (corner[i] - foot[i]).norm() / door.height_m;
  }
  const ExpectedLine lintel(corner[0], corner[1]);
  e.lintel = CoverOf(view, lintel);
  e.frame_lintel =
      Nested(view, lintel, foot[0] - corner[0], kNearestFrame_m * std::min(metre_px[0], metre_px[1]),
             kFarthestFrame_m * std::max(metre_px[0], metre_px[1]));
  const double slant = lintel.length_px / (door.left - door.right).norm();  // px per metre of width
  std::array<Eigen::Vector2d, 2> end;
  for (int i = 0; i < 2; ++i) {
    const ExpectedLine upright = UprightIn(view, corner[i], foot[i]);
    e.foot_inside[i] = Inside(view, foot[i]);
    e.uprights[i] = CoverOf(view, upright);
    e.hangs_m[i] = -e.uprights[i].last_px / metre_px[i];
    end[i] = upright.p + (upright.length_px + e.uprights[i].last_px) * upright.direction;
    e.frame_uprights[i] =
        Nested(view, upright, corner[1 - i] - corner[i], std::max(2.0, 0.5 * kNearestFrame_m * slant),
               kFarthestFrame_m * metre_px[i]);
  }
  const bool both_hang = std::min(e.hangs_m[0], e.hangs_m[1]) > kHangs_m ||
                         (!e.foot_inside[0] && !e.foot_inside[1] &&
                          std::max(e.uprights[0].last_px, e.uprights[1].last_px) < -kBorder_px);
  if (both_hang) e.sill = CoverOf(view, {end[0], end[1]}, kSill_px).share;
  e.log_odds = LogOdds(e);
  return e;
}

}  // namespace priamos::head
