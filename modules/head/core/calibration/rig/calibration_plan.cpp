#include "head/core/calibration/rig/calibration_plan.hpp"

#include <algorithm>

#include "common/geometry.hpp"

namespace priamos::head {

void StepInterval::Describe(Archive& a) {
  a.Integer("first", first, {"step", 0, 2000, "lower end"});
  a.Integer("last", last, {"step", 0, 2000, "upper end"});
  if (last < first) a.Refuse("last", "not less than first");
  a.Integer("nodes", nodes, {"-", 1, 50, "settings in between, ends included"});
}

std::vector<int> StepInterval::Steps() const {
  std::vector<int> steps;
  steps.reserve(static_cast<std::size_t>(nodes));
  for (int i = 0; i < nodes; ++i) {
    steps.push_back(nodes == 1 ? (first + last) / 2 : first + (last - first) * i / (nodes - 1));
  }
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  return steps;
}

void CalibrationPlan::Describe(Archive& a) {
  a.Number("pan_deg", pan_deg,
           {"deg", 0, 60, "the mechanics are calibrated at this pan, its negative and 0"});
  a.Number("tilt_deg", tilt_deg,
           {"deg", 0, 40, "the mechanics are calibrated at this tilt, its negative and 0"});
  a.Number(
      "vergence_deg", vergence_deg,
      {"deg", 0, 20, "the mechanics are calibrated at this vergence of each camera, its negative and 0"});
  a.Number("convergence_deg", convergence_deg,
           {"deg", 0, 10, "vergence of both cameras where it does not matter"});
  a.Number("grid_pan_deg", grid_pan_deg,
           {"deg", 0, 20, "every zoom and focus is seen at both signs of this pan"});
  a.Number("grid_tilt_deg", grid_tilt_deg,
           {"deg", 0, 20, "every zoom and focus is seen at both signs of this tilt"});
  a.Number("grid_tele_share", grid_tele_share,
           {"-", 0, 1, "share of grid_pan_deg and grid_tilt_deg at the longest focal length"});
  a.Section("zoom", zoom, "interval of zoom");
  a.Section("focus", focus, "interval of focus");
}

std::vector<HeadSetting> CalibrationPlan::Settings() const {
  const double pan = Radians(pan_deg), tilt = Radians(tilt_deg), turn = Radians(vergence_deg);
  const double in = Radians(convergence_deg);
  const std::vector<int> zooms = zoom.Steps(), focuses = focus.Steps();
  std::vector<HeadSetting> settings;
  const auto add = [&](double p, double t, double left, double right, int z, int f) {
    settings.push_back({p, t, {left, right}, {z, z}, {f, f}});
  };
  const int wide = zooms.front(), middle = focuses[focuses.size() / 2];
  for (const double t : {-tilt, 0.0, tilt}) {
    for (const double p : {-pan, 0.0, pan}) add(p, t, -in, in, wide, middle);
  }
  for (const double p : {-pan / 2, pan / 2}) {
    for (const double left : {-turn, turn}) {
      for (const double right : {-turn, turn}) add(p, 0, left, right, wide, middle);
    }
  }
  double side = 1;
  for (auto z = zooms.rbegin(); z != zooms.rend(); ++z) {
    const double tele = zooms.size() < 2 ? 0 : double(*z - zooms.front()) / (zooms.back() - zooms.front());
    const double share = 1 + tele * (grid_tele_share - 1);
    // Both diagonals of the picture, in turn.
    double diagonal = 1;
    for (const int f : focuses) {
      for (const double sign : {-side, side}) {
        add(sign * share * Radians(grid_pan_deg), sign * diagonal * share * Radians(grid_tilt_deg), -in, in,
            *z, f);
      }
      side = -side;
      diagonal = -diagonal;
    }
  }
  return settings;
}

}  // namespace priamos::head
