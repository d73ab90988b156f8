#include "cli/report/report_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/report/report_door.hpp"
#include "cli/report/report_fix_panel.hpp"
#include "cli/report/report_plan_view.hpp"
#include "cli/report/report_table.hpp"
#include "cli/report/report_timeline.hpp"
#include "common/drawing/legend.hpp"

namespace priamos::cli {
namespace {

using drawing::Box, drawing::Drawing, drawing::Font;
using Eigen::Vector2d;
using namespace colours;

constexpr double kWidth = 1200, kMargin = 36, kInner = kWidth - 2 * kMargin;
constexpr double kAxisWidth = 64, kAxisHeight = 40, kTallestPlan = 1000, kPanelHeight = 400;
constexpr Font kTitleFont{44, true};
constexpr drawing::Layer kGood{"verdict", "", {.fill = kFix}}, kFailed{"verdict", "", {.fill = kBad}};

/// Where it took place.
struct Scene {
  const GroundPlan& plan;
  std::vector<TrueThing> things;
  Vector2d footprint_m;
};

/// The largest size, up to that of `font`, at which `text` is no wider than `width`.
Font Fitting(const std::string& text, Font font, double width) {
  const double natural = drawing::MeasureText(text, font).width;
  if (natural > width) font.size *= width / natural;
  return font;
}

/// Title and verdict; returns where the next thing begins.
double DrawHeader(Drawing& page, const Summary& summary) {
  const std::string verdict = Verdict(summary);
  const auto extent = drawing::MeasureText(verdict, kBoldFont);
  const Box badge{kWidth - kMargin - extent.width - 32, 26, extent.width + 32, 56};
  page.FillBox(summary.passed && summary.contacts == 0 ? kGood : kFailed, badge);
  page.Write(layers::kText, {badge.x + 16, badge.y + 39}, verdict, kBoldFont, kPaper);
  const std::string title = fmt::format("{}, seed {}", summary.scenario, summary.seed);
  page.Write(layers::kText, {kMargin, 70}, title, Fitting(title, kTitleFont, badge.x - 2 * kMargin), kInk);
  return 104;
}

/// Numbers of whole metres beside and below the plan, not nearer to each other than they can be read.
void DrawAxes(Drawing& page, const MapView& view, const Extent& extent, double px_per_m) {
  const double every_m = px_per_m > 70 ? 1 : px_per_m > 30 ? 2 : 5;
  const Box& window = view.window();
  const auto numbers = [&](double low, double high, const auto& write) {
    const int last = static_cast<int>(std::floor(high / every_m));
    for (int i = static_cast<int>(std::ceil(low / every_m)); i <= last; ++i)
      write(i * every_m, fmt::format("{:.0f}{}", i * every_m, i == last ? " m" : ""));
  };
  numbers(extent.low.x(), extent.high.x(), [&](double x, const std::string& text) {
    const double width = drawing::MeasureText(text, kSmallFont).width;
    const double left = std::min(view.ToPage({x, 0}).x() - width / 2, window.right() - width);
    page.Write(layers::kText, {left, window.bottom() + 30}, text, kSmallFont, kFaint);
  });
  numbers(extent.low.y(), extent.high.y(), [&](double y, const std::string& text) {
    const double left = window.x - 10 - drawing::MeasureText(text, kSmallFont).width;
    page.Write(layers::kText, {left, view.ToPage({0, y}).y() + 9}, text, kSmallFont, kFaint);
  });
}

/// The whole plan, from `top`; returns where the next thing begins.
double DrawOverview(Drawing& page, double top, const RunRecord& record, const RunInfo& info,
                    const Scene& scene) {
  const Extent extent = ExtentOfRun(scene.plan, scene.things, record);
  const double room = kInner - kAxisWidth;
  const double scale = std::min(room / extent.size().x(), kTallestPlan / extent.size().y());
  const Box window{kMargin + kAxisWidth + (room - scale * extent.size().x()) / 2, top,
                   scale * extent.size().x(), scale * extent.size().y()};
  MapView view(page, window, extent.centre(), scale);
  DrawFloor(view, extent);
  DrawPlan(view, scene.plan, true);
  DrawThings(view, scene.things, true);
  if (info.door) DrawAxis(view, *info.door);
  DrawRobots(view, record, scene.footprint_m);
  DrawEllipses(view, record);
  DrawTruth(view, record);
  DrawBelief(view, record);
  if (info.door) DrawLooks(view, record, *info.door);
  DrawContacts(view, record);
  view.SetLabels();
  DrawAxes(page, view, extent, scale);
  return window.bottom() + kAxisHeight + 20;
}

/// Title of a panel; returns the window below it.
Box BeginPanel(Drawing& page, const Box& panel, const std::string& title) {
  page.Write(layers::kText, {panel.x, panel.y + 28}, title, Fitting(title, kBoldFont, panel.width), kInk);
  page.Line(layers::kGrid, {panel.x, panel.y + 42}, {panel.right(), panel.y + 42});
  return {panel.x, panel.y + 54, panel.width, panel.height - 54};
}

void DrawPassage(Drawing& page, const Box& panel, const RunRecord& record, const RunInfo& info,
                 const Scene& scene) {
  constexpr double kScale = 210, kEvery_m = 0.06, kNear_m = 2, kOpacity = 0.04;
  const Pose2 map_from_door = BuiltDoor(info)->map_from_door();
  MapView view(page, BeginPanel(page, panel, "in the door"), map_from_door.translation(), kScale);
  const Vector2d reach(3, 3);
  DrawFloor(view, {map_from_door.translation() - reach, map_from_door.translation() + reach});
  DrawPlan(view, scene.plan, false);
  DrawThings(view, scene.things, false);
  DrawAxis(view, *info.door);
  Vector2d last(1e9, 1e9);
  for (const auto& truth : record.truth) {
    if ((PositionOf(truth) - last).norm() < kEvery_m) continue;
    last = PositionOf(truth);
    if ((last - map_from_door.translation()).norm() > kNear_m) continue;
    view.Area(layers::kSwept, FootprintOutline({truth.x_m, truth.y_m, truth.yaw_rad}, scene.footprint_m),
              kOpacity);
  }
  if (const auto crossing = CrossingOf(record, map_from_door))
    if (const auto at = TruthAt(record, crossing->utime)) DrawRobot(view, *at, scene.footprint_m);
  DrawTruth(view, record);
  DrawBelief(view, record);
  DrawContacts(view, record);
  view.SetLabels();
}

std::string DoorFigures(const Summary& summary, const std::optional<DoorPlan>& door) {
  std::string gap = fmt::format("smallest gap {:.1f} cm", summary.min_gap_m * 100);
  if (!SeeksTheDoor(summary)) {
    const auto honoured = summary.hand->honoured();
    return fmt::format("{} of the free motion wished was made; {}",
                       honoured ? fmt::format("{:.1f} %", *honoured * 100) : "-", gap);
  }
  if (!door) return gap;
  if (!summary.lateral_at_door_m) return fmt::format("door {} was not crossed; {}", door->name, gap);
  return fmt::format("in the door: {:+.1f} cm lateral, {:+.2f}° heading; {}",
                     *summary.lateral_at_door_m * 100, summary.heading_at_door_deg.value_or(0), gap);
}

std::vector<std::string> Figures(const Summary& summary, const std::optional<DoorPlan>& door) {
  std::vector<std::string> lines{DoorFigures(summary, door)};
  for (std::size_t i = 0; i < summary.fixes.size(); ++i) {
    const FixSummary& fix = summary.fixes[i];
    lines.push_back(
        fmt::format("fix {} at {:.1f} s: {:.1f} cm, {:.2f}° → {:.1f} cm, {:.2f}°; its sigma {:.1f} cm", i + 1,
                    fix.t_s, fix.error_before_m * 100, fix.error_before_deg, fix.error_after_m * 100,
                    fix.error_after_deg, fix.sigma_m * 100));
  }
  lines.push_back(fmt::format("{:.1f} s, mean speed {:.2f} m/s", summary.duration_s, summary.mean_speed_m_s));
  lines.push_back(fmt::format("radio: {} bytes up (robot to workstation), {} bytes down", summary.up.bytes,
                              summary.down.bytes));
  return lines;
}

/// The run in words; returns where it ends.
double WriteFigures(Drawing& page, double top, const Summary& summary, const RunInfo& info) {
  double y = BeginPanel(page, {kMargin, top, kInner, 60}, "figures").y;
  for (const std::string& line : Figures(summary, info.door)) {
    y += 42;
    page.Write(layers::kText, {kMargin, y - 8}, line, Fitting(line, kBodyFont, kInner), kInk);
  }
  return y;
}

}  // namespace

Drawing DrawRun(const RunRecord& record, const Summary& summary, const RunInfo& info,
                const GroundPlan& plan) {
  const Scene scene{plan, ThingsBeyond(plan, info.world), info.world.body.size_m};
  Drawing page(kWidth, 0, kPaper);
  const double panels = DrawOverview(page, DrawHeader(page, summary), record, info, scene);
  const double width = (kInner - kMargin) / 2;
  if (info.door) DrawPassage(page, {kMargin, panels, width, kPanelHeight}, record, info, scene);
  const double beside = info.door ? kMargin + width + kMargin : kMargin;
  DrawFixErrors(page, BeginPanel(page, {beside, panels, width, kPanelHeight}, "belief − truth at the fixes"),
                OnPlan(record, info));
  // After all that it explains.
  const Box legend = BeginPanel(page, {kMargin, panels + kPanelHeight + 30, kInner, 60}, "legend");
  const double height = drawing::WriteLegend(page, legend.x, legend.y, kInner, {kBodyFont, kInk});
  page.SetHeight(WriteFigures(page, legend.y + height + 30, summary, info) + kMargin);
  return page;
}

}  // namespace priamos::cli
