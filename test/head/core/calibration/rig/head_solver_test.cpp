#include "head/core/calibration/rig/head_solver.hpp"

#include <gmock/gmock.h>

#include "common/geometry.hpp"
#include "test/support/head_sweep.hpp"

namespace priamos::head {
namespace {

using support::ImageError, support::Sweep;
using testing::HasSubstr;

/// Few nodes, so that a test takes a second.
CalibrationPlan SmallPlan() {
  CalibrationPlan plan;
  plan.zoom = {50, 950, 3};
  plan.focus = {1200, 1800, 2};
  return plan;
}

HeadSetting At(double pan_deg, double tilt_deg, double vergence_deg, int zoom, int focus) {
  const double v = Radians(vergence_deg);
  return {Radians(pan_deg), Radians(tilt_deg), {-v, v}, {zoom, zoom}, {focus, focus}};
}

TEST(HeadSolver, PredictsSettingsOfPanTiltAndVergenceThatWereNotVisited) {
  support::SimulatedHead simulated(1);
  const auto views = Sweep(simulated, SmallPlan().Settings(), {}, 1);
  const auto dut = SolveHead(views);
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_LT(dut->mean_error_px, 0.03);
  for (const HeadSetting& setting :
       {At(30, 0, 1.15, 50, 1200), At(-25, 10, 3, 500, 1200), At(7, -5, 0, 950, 1800)}) {
    for (int camera = 0; camera < kCameras; ++camera) {
      EXPECT_LT(ImageError(dut->model, simulated, setting, camera), 0.15)
          << "camera " << camera << ", pan " << Degrees(setting.pan_rad);
    }
  }
}

TEST(HeadSolver, OriginIsWhereThePanAxisMeetsTheTiltAxis) {
  support::SimulatedHead simulated(2);
  const auto dut = SolveHead(Sweep(simulated, SmallPlan().Settings(), {}, 2));
  ASSERT_TRUE(dut) << dut.reason();
  // The axis of the pan is found by how cameras move, not by the drawing, which is off by millimetres.
  EXPECT_LT((dut->model.geometry.BaseFromHead().translation().head<2>() -
             simulated.geometry().BaseFromHead().translation().head<2>())
                .norm(),
            0.0005);
}

/// The sweep as the head makes it with these motors, and how wrong its table is.
support::TableError TableError(const PositionerConfig& motors) {
  support::SimulatedHead simulated(3);
  CalibrationPlan plan = SmallPlan();
  plan.zoom.nodes = plan.focus.nodes = 4;
  const auto dut = SolveHead(Sweep(simulated, plan.Settings(), motors, 3));
  return dut ? MeasureTable(dut->model, simulated, plan) : support::TableError{1e9, 1e9};
}

TEST(HeadSolver, TheTableHoldsBetweenItsNodes) {
  const support::TableError dut = TableError({});
  EXPECT_LT(dut.between_px, 0.1);
  EXPECT_LT(dut.between_px, 1.5 * dut.at_nodes_px);
}

TEST(HeadSolver, PlayOfTheGearsSpoilsASweepWithoutOneSidedApproach) {
  PositionerConfig direct;
  direct.approach_rad = 0;
  direct.approach_steps = 0;
  EXPECT_GT(TableError(direct).between_px, 2 * TableError({}).between_px);
  EXPECT_GT(TableError(direct).between_px, 0.1);
}

TEST(HeadSolver, RefusesWhatDoesNotDetermineTheHead) {
  EXPECT_THAT(SolveHead({}).reason(), HasSubstr("no views"));
  support::SimulatedHead simulated(4);
  auto views = Sweep(simulated, {At(0, 0, 1, 50, 1600)}, {}, 4);
  views[0].discs.resize(5);
  EXPECT_THAT(SolveHead(views).reason(), HasSubstr("6"));
  views = Sweep(simulated, {At(0, 0, 1, 50, 1600)}, {}, 4);
  views[0].discs[3].centroid_px.x() = std::nan("");
  EXPECT_THAT(SolveHead(views).reason(), HasSubstr("finite"));
  views[0].camera = 3;
  EXPECT_THAT(SolveHead(views).reason(), HasSubstr("no camera 3"));
}

TEST(HeadSolver, RefusesAGridWithAHole) {
  support::SimulatedHead simulated(5);
  auto views = Sweep(simulated, SmallPlan().Settings(), {}, 5);
  std::erase_if(views, [](const HeadView& v) {
    return v.camera == kLeft && v.setting.zoom_step[0] == 500 && v.setting.focus_step[0] == 1800;
  });
  EXPECT_THAT(SolveHead(views).reason(), HasSubstr("zoom 500 and focus 1800"));
}

}  // namespace
}  // namespace priamos::head
