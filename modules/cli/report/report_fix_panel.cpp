#include "cli/report/report_fix_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "cli/report/report_plan_view.hpp"
#include "cli/report/report_timeline.hpp"

namespace priamos::cli {
namespace {

using Eigen::Vector2d;

constexpr drawing::Layer kNoError{"no-error", "no error", {.fill = colours::kTruth}, drawing::Symbol::kDot};
constexpr drawing::Layer kBefore{
    "error-before", "error before the first fix", {.fill = colours::kBelief}, drawing::Symbol::kDot};

/// The belief at one time, relative to the truth.
struct Offset {
  Vector2d error{0, 0};
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

/// The estimate nearest to `utime` that lies before (or after) it by 40 ms.
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

struct Jump {
  int number;
  Offset before, after;
};

std::vector<Jump> JumpsOf(const RunRecord& record) {
  std::vector<Jump> jumps;
  int number = 0;
  for (const LookSpan& look : LooksOf(record)) {
    ++number;
    const auto before = OffsetAt(record, look.end_utime, true);
    const auto after = OffsetAt(record, look.end_utime, false);
    if (before && after) jumps.push_back({number, *before, *after});
  }
  return jumps;
}

/// Distance of the rings [m]: five of them hold the largest error.
double RingStep(const std::vector<Jump>& jumps) {
  double largest_m = 0;
  for (const Jump& jump : jumps)
    for (const Offset& offset : {jump.before, jump.after})
      if (offset.error.allFinite()) largest_m = std::max(largest_m, offset.error.norm());
  constexpr std::array<double, 7> kSteps{0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1};
  const auto step =
      std::find_if(kSteps.begin(), kSteps.end(), [&](double s) { return 4.5 * s >= largest_m; });
  return step == kSteps.end() ? kSteps.back() : *step;
}

void DrawRings(MapView& view, double step_m) {
  for (int i = 1; i <= 5; ++i) {
    const double r_m = i * step_m;
    auto ring = EllipseOutline({0, 0}, Eigen::Matrix2d::Identity() * r_m * r_m, 1);
    ring.push_back(ring.front());
    view.Line(layers::kGrid, ring);
    if (i == 2 || i == 4)
      view.Label(Vector2d(0.7, 0.7) * r_m, fmt::format("{:.0f} cm", r_m * 100), kSmallFont, colours::kFaint,
                 2);
  }
  view.Line(layers::kGrid, {{-5 * step_m, 0}, {5 * step_m, 0}});
  view.Line(layers::kGrid, {{0, -5 * step_m}, {0, 5 * step_m}});
}

}  // namespace

void DrawFixErrors(drawing::Drawing& page, const drawing::Box& window, const RunRecord& record) {
  const auto jumps = JumpsOf(record);
  const double step_m = RingStep(jumps);
  if (jumps.empty()) {
    page.Write(layers::kText, {window.x, window.y + kBodyFont.size}, "no fix corrected the pose", kBodyFont,
               colours::kInk);
    return;
  }
  MapView view(page, window, {0, 0}, std::min(window.width, window.height) / (10.4 * step_m));
  for (const Jump& jump : jumps)
    view.Area(layers::kSigma, EllipseOutline(jump.after.error, jump.after.covariance, 2));
  view.Dot(kBefore, jumps.front().before.error, 8);
  for (const Jump& jump : jumps) {
    view.Arrow(layers::kCorrection, jump.before.error, jump.after.error, 14);
    view.Label((jump.before.error + jump.after.error) / 2, fmt::format("{}", jump.number), kBoldFont,
               colours::kFix, 10);
  }
  view.Dot(kNoError, {0, 0}, 6);
  DrawRings(view, step_m);
  view.SetLabels();
}

}  // namespace priamos::cli
