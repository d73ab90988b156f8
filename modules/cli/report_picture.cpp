#include "cli/report_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "cli/report_canvas.hpp"
#include "cli/report_plan_view.hpp"
#include "cli/report_table.hpp"
#include "cli/report_timeline.hpp"
#include "common/time.hpp"

namespace priamos::cli {
namespace {

using Eigen::Vector2d;
using namespace colours;

constexpr int kWidth = 1600, kHeight = 1236, kMargin = 36, kHeader = 84, kPanelHeight = 300;
constexpr int kPlanHeight = kHeight - kHeader - kPanelHeight - 3 * kMargin + 8;

void DrawScaleBar(Page& page, double right, double bottom, double px_per_m) {
  const double x = right - px_per_m;
  page.FillBox(x, bottom - 6, px_per_m / 2, 6, kInk);
  page.FillBox(x + px_per_m / 2, bottom - 6, px_per_m / 2, 6, kFaint);
  page.Text(x - 4, bottom - 14, "0", 11, kInk);
  page.Text(x + px_per_m - 16, bottom - 14, "1 m", 11, kInk);
}

void DrawPlan(Page& page, const RunRecord& record, const RunInfo& info, const GroundPlan& plan) {
  const Extent extent = ExtentOf(plan);
  const cv::Rect window(kMargin, kHeader, kWidth - 2 * kMargin, kPlanHeight);
  const double scale = std::min(window.width / extent.size().x(), window.height / extent.size().y());
  View view(page, window, extent.centre(), scale);
  DrawFloor(view, extent);
  DrawAxis(view, info.door);
  DrawWalls(view, plan);
  DrawDoorName(view, info.door);
  DrawRobots(view, record, info.door.map_from_door());
  DrawEllipses(view, record);
  DrawTruth(view, record);
  DrawBelief(view, record, 1.8);
  DrawLooks(view, record, info.door);
  const Vector2d corner = extent.high - extent.centre();
  DrawScaleBar(page, kMargin + window.width / 2.0 + corner.x() * scale - 60,
               kHeader + window.height / 2.0 + corner.y() * scale - 50, scale);
}

void DrawHeader(Page& page, const Summary& summary) {
  const bool good = summary.passed && summary.contacts == 0;
  const std::string verdict = Verdict(summary);
  page.Text(kMargin, 54, fmt::format("{}, seed {}", summary.scenario, summary.seed), 21, kInk, true);
  const double width = page.TextWidth(verdict, 15, true);
  page.FillBox(kWidth - kMargin - width - 32, 24, width + 32, 42, good ? kFix : kBad);
  page.Text(kWidth - kMargin - width - 16, 53, verdict, 15, kPaper, true);
}

/// Title of a panel; returns the window below it.
cv::Rect BeginPanel(Page& page, int x, int width, const std::string& title) {
  const int top = kHeight - kMargin - kPanelHeight;
  page.Text(x, top + 14, title, 13, kInk, true);
  page.Line(x, top + 26, x + width, top + 26, kGrid, 2);
  return {x, top + 36, width, kPanelHeight - 36};
}

void DrawPassage(Page& page, const RunRecord& record, const Summary& summary, const RunInfo& info,
                 const GroundPlan& plan) {
  const cv::Rect window = BeginPanel(page, kMargin, 520, "in the door");
  const Pose2 map_from_door = info.door.map_from_door();
  View view(page, {window.x, window.y, window.width, window.height - 34}, map_from_door.translation(), 175);
  DrawFloor(view,
            {map_from_door.translation() - Vector2d(3, 3), map_from_door.translation() + Vector2d(3, 3)});
  DrawWalls(view, plan);
  DrawAxis(view, info.door);
  constexpr double kEvery_m = 0.1;
  Vector2d last(1e9, 1e9);
  for (const auto& truth : record.truth) {
    if ((PositionOf(truth) - last).norm() < kEvery_m) continue;
    last = PositionOf(truth);
    view.Fill(FootprintOutline({truth.x_m, truth.y_m, truth.yaw_rad}), kTruth, 0.05);
  }
  if (const auto crossing = CrossingOf(record, map_from_door))
    if (const auto at = TruthAt(record, crossing->utime)) DrawRobot(view, *at, kTruth, 0.12);
  DrawTruth(view, record);
  DrawBelief(view, record, 1.8);
  const std::string caption = summary.lateral_at_door_m
                                  ? fmt::format("{:+.1f} cm lateral, {:+.2f} deg, smallest gap {:.1f} cm",
                                                *summary.lateral_at_door_m * 100,
                                                *summary.heading_at_door_deg, summary.min_gap_m * 100)
                                  : "the door was not crossed";
  page.Text(window.x, window.y + window.height - 8, caption, 12, kInk);
}

/// The estimate nearest to `utime` that lies before (or after) it by 40 ms, relative to the truth.
struct Offset {
  Vector2d error{0, 0};
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};
std::optional<Offset> OffsetAt(const RunRecord& record, std::int64_t utime, bool before) {
  constexpr std::int64_t kAside_us = 40'000;
  const pose_t* nearest = nullptr;
  for (const pose_t& pose : record.poses) {
    if (before && pose.utime <= utime - kAside_us) nearest = &pose;
    if (!before && !nearest && pose.utime >= utime + kAside_us) nearest = &pose;
  }
  const auto truth = nearest ? TruthAt(record, nearest->utime) : std::nullopt;
  if (!truth) return std::nullopt;
  return Offset{PositionOf(*nearest) - truth->translation(), CovarianceOf(*nearest)};
}

void DrawRings(View& view, double largest_m) {
  for (double r_m = 0.05; r_m <= largest_m; r_m += 0.05) {
    const auto ring = EllipseOutline({0, 0}, Eigen::Matrix2d::Identity() * r_m * r_m, 1);
    view.Polyline(ring, kGrid, 1.2, true);
    if (std::lround(r_m * 100) % 10 == 0)
      view.Label({0, r_m}, 4, -3, fmt::format("{:.0f} cm", r_m * 100), 9, kFaint);
  }
  view.Polyline({{-largest_m, 0}, {largest_m, 0}}, kGrid, 1);
  view.Polyline({{0, -largest_m}, {0, largest_m}}, kGrid, 1);
}

void DrawFixErrors(Page& page, const RunRecord& record) {
  const cv::Rect window = BeginPanel(page, 592, 400, "believed minus true position at the fixes");
  View view(page, window, {0, 0}, 500);
  DrawRings(view, 0.25);
  const auto looks = LooksOf(record);
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const auto before = OffsetAt(record, looks[i].end_utime, true);
    const auto after = OffsetAt(record, looks[i].end_utime, false);
    if (!before || !after) continue;
    view.Fill(EllipseOutline(after->error, after->covariance, 2), kBelief, 0.16);
    view.Polyline(EllipseOutline(after->error, after->covariance, 2), kBelief, 1, true);
    if (i == 0) view.Dot(before->error, 5, kBelief);
    view.Arrow(before->error, after->error, kFix, 2);
    view.Dot(after->error, 3.5, kFix);
    view.Label((before->error + after->error) / 2, 8, 4, fmt::format("{}", i + 1), 12, kFix, true);
  }
  if (looks.empty()) view.Label({0, 0}, -88, 5, "no fix corrected the pose", 12, kInk);
  view.Dot({0, 0}, 3.5, kTruth);
}

void DrawLegend(Page& page, const Summary& summary) {
  const cv::Rect window = BeginPanel(page, 1028, kWidth - kMargin - 1028, "legend");
  const auto row = [&](int i) { return window.y + 22.0 + i * 27; };
  const double x = window.x, text_x = window.x + 58;
  page.Line(x, row(0) - 5, x + 42, row(0) - 5, kTruth, 3);
  page.Text(text_x, row(0), "true path of the base centre, and its footprint", 12, kInk);
  page.Line(x, row(1) - 5, x + 42, row(1) - 5, kBelief, 1.8);
  page.Text(text_x, row(1), "believed path, ellipses of 2 sigma", 12, kInk);
  View symbols(page, {window.x, int(row(2)) - 20, 50, 28}, {0, 0}, 1);
  symbols.Dot({-4, 0}, 11, kFix);
  symbols.Label({-4, 0}, -5, 6, "1", 12, kPaper, true);
  page.Text(text_x, row(2), "look: left, then right side of the door", 12, kInk);
  View arrow(page, {window.x, int(row(3)) - 20, 50, 28}, {0, 0}, 1);
  arrow.Arrow({-24, 0}, {18, 0}, kFix, 2);
  page.Text(text_x, row(3), "correction of the pose by a fix", 12, kInk);

  const double y = row(4) + 14;
  for (std::size_t i = 0; i < summary.fixes.size() && i < 3; ++i) {
    const FixSummary& fix = summary.fixes[i];
    page.Text(x, y + 24.0 * double(i),
              fmt::format("fix {}:  {:.1f} cm, {:.2f} deg  ->  {:.1f} cm, {:.2f} deg", i + 1,
                          fix.error_before_m * 100, fix.error_before_deg, fix.error_after_m * 100,
                          fix.error_after_deg),
              12, kInk);
  }
  page.Text(x, y + 76,
            fmt::format("{:.1f} s, {:.2f} m/s mean speed", summary.duration_s, summary.mean_speed_m_s), 12,
            kInk);
  page.Text(x, y + 100, fmt::format("radio: {} B up, {} B down", summary.up.bytes, summary.down.bytes), 12,
            kInk);
}

}  // namespace

cv::Mat DrawRun(const RunRecord& record, const Summary& summary, const RunInfo& info,
                const GroundPlan& plan) {
  Page page(kWidth, kHeight, kPaper);
  DrawHeader(page, summary);
  DrawPlan(page, record, info, plan);
  DrawPassage(page, record, summary, info, plan);
  DrawFixErrors(page, record);
  DrawLegend(page, summary);
  return page.Finish();
}

}  // namespace priamos::cli
