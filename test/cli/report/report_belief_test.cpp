#include "cli/report/report_belief.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "report_synthetic_run.hpp"

namespace priamos::cli {
namespace {

constexpr double kAfterFixes_s = 14;

std::int64_t At(double t_s) {
  return kRunBegin + std::llround(t_s * 1e6);
}

DoorPlan DoorTurnedBy(double yaw_deg) {
  DoorPlan door = TestInfo().door;
  door.yaw_deg = yaw_deg;
  return door;
}

TEST(ReportBelief, IsBeliefMinusTruthInTheFrameOfTheDoor) {
  const RunRecord record = SyntheticRun{}.Record();
  const auto dut = BeliefAt(record, DoorTurnedBy(0), At(kAfterFixes_s));
  ASSERT_TRUE(dut);
  EXPECT_NEAR(dut->along_m, 0.006, 1e-9);
  EXPECT_NEAR(dut->lateral_m, 0.008, 1e-9);
  EXPECT_NEAR(Degrees(dut->heading_rad), 0.2, 1e-9);
  EXPECT_NEAR(dut->lateral_sigma_m, 0.017, 1e-9);
  const auto turned = BeliefAt(record, DoorTurnedBy(90), At(kAfterFixes_s));
  EXPECT_NEAR(turned->along_m, 0.008, 1e-9);
  EXPECT_NEAR(turned->lateral_m, -0.006, 1e-9);
  EXPECT_NEAR(turned->lateral_sigma_m, 0.019, 1e-9);
}

TEST(ReportBelief, NeesWeighsTheErrorByTheCovariance) {
  const auto dut = BeliefAt(SyntheticRun{}.Record(), DoorTurnedBy(0), At(kAfterFixes_s));
  const double x = 0.006 / 0.019, y = 0.008 / 0.017, rho = 0.3;
  EXPECT_NEAR(dut->nees, (x * x - 2 * rho * x * y + y * y) / (1 - rho * rho) + 1, 1e-6);
}

TEST(ReportBelief, NothingIsSaidOfATimeWithoutPose) {
  EXPECT_FALSE(BeliefAt(SyntheticRun{}.Record(), DoorTurnedBy(0), At(100)));
  EXPECT_FALSE(BeliefAt(RunRecord{}, DoorTurnedBy(0), At(1)));
}

}  // namespace
}  // namespace priamos::cli
