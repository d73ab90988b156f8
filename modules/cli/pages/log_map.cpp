#include "cli/pages/log_map.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "cli/report/report_parts.hpp"
#include "common/drawing/legend.hpp"

namespace priamos::cli {
namespace {

using drawing::Box, drawing::Drawing;
using Eigen::Vector2d;

constexpr double kWidth = 1200, kMargin = 36, kInner = kWidth - 2 * kMargin, kTallestPlan = 1000;
constexpr drawing::Layer kHeard{
    "heard-wall", "wall that the sonars heard", {.line = colours::kFix, .width = 4}};

/// The newest message about each wall; one that is gone is not drawn.
void DrawWalls(MapView& view, const RunRecord& record) {
  std::map<std::pair<std::int32_t, std::int16_t>, feature_t> walls;
  for (const features_t& message : record.features)
    for (const feature_t& feature : message.features) walls[{message.store, feature.id}] = feature;
  for (const auto& [id, wall] : walls) {
    if (wall.kind != feature_t::WALL) continue;
    const Vector2d middle(wall.x_m, wall.y_m), along(std::cos(wall.yaw_rad), std::sin(wall.yaw_rad));
    view.Line(kHeard, {middle - along * wall.length_m / 2, middle + along * wall.length_m / 2});
  }
}

/// Of a stream in the order of its times, what is not later.
template <class T>
std::vector<T> Until(const std::vector<T>& stream, std::int64_t utime) {
  std::vector<T> until;
  std::copy_if(stream.begin(), stream.end(), std::back_inserter(until),
               [&](const T& message) { return message.utime <= utime; });
  return until;
}

}  // namespace

Extent ExtentOfLog(const RunRecord& record, const std::optional<GroundPlan>& plan) {
  constexpr double kAround_m = 1.5;
  Extent extent{{1e9, 1e9}, {-1e9, -1e9}};
  const auto include = [&](const Vector2d& low, const Vector2d& high) {
    extent.low = extent.low.cwiseMin(low);
    extent.high = extent.high.cwiseMax(high);
  };
  const Vector2d around(kAround_m, kAround_m);
  for (const pose_t& pose : record.poses) include(PositionOf(pose) - around, PositionOf(pose) + around);
  if (plan) {
    const Extent of_plan = ExtentOf(*plan);
    include(of_plan.low, of_plan.high);
  }
  return extent.low.x() > extent.high.x() ? Extent{} : extent;
}

Drawing DrawLogMap(const RunRecord& record, const std::optional<GroundPlan>& plan, const Extent& extent) {
  const double scale = std::min(kInner / extent.size().x(), kTallestPlan / extent.size().y());
  Drawing page(kWidth, 0, colours::kPaper);
  const Box window{kMargin + (kInner - scale * extent.size().x()) / 2, kMargin, scale * extent.size().x(),
                   scale * extent.size().y()};
  MapView view(page, window, extent.centre(), scale);
  DrawFloor(view, extent);
  if (plan) DrawPlan(view, *plan, true);
  DrawWalls(view, record);
  DrawEllipses(view, record);
  DrawTruth(view, record);
  DrawBelief(view, record);
  view.SetLabels();
  const double height =
      drawing::WriteLegend(page, kMargin, window.bottom() + kMargin, kInner, {kBodyFont, colours::kInk});
  page.SetHeight(window.bottom() + height + 2 * kMargin);
  return page;
}

RunRecord MapRecordUntil(const RunRecord& record, std::int64_t utime) {
  RunRecord until;
  until.poses = Until(record.poses, utime);
  until.truth = Until(record.truth, utime);
  for (features_t message : record.features) {
    std::erase_if(message.features, [&](const feature_t& feature) { return feature.utime_seen > utime; });
    if (!message.features.empty()) until.features.push_back(std::move(message));
  }
  return until;
}

}  // namespace priamos::cli
