#include "head/core/calibration/rig/calibration_plan.hpp"

#include <gmock/gmock.h>

#include <map>
#include <set>

#include "common/config.hpp"
#include "common/geometry.hpp"

namespace priamos::head {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(StepIntervalTest, EndsAreNodes) {
  EXPECT_THAT((StepInterval{50, 1850, 7}.Steps()), ElementsAre(50, 350, 650, 950, 1250, 1550, 1850));
  EXPECT_THAT((StepInterval{100, 200, 1}.Steps()), ElementsAre(150));
  EXPECT_THAT((StepInterval{10, 11, 5}.Steps()), ElementsAre(10, 11)) << "no step twice";
}

TEST(StepIntervalTest, AnIntervalThatRunsBackwardsIsRefused) {
  try {
    ParseConfig<StepInterval>("plan.toml", "first = 300\nlast = 200\n");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("not less than first"));
  }
}

TEST(CalibrationPlanTest, EveryNodeIsSeenTwiceFromOppositeSides) {
  const CalibrationPlan dut;
  std::map<std::pair<int, int>, std::vector<HeadSetting>> nodes;
  const auto settings = dut.Settings();
  for (std::size_t i = 17; i < settings.size(); ++i)
    nodes[{settings[i].zoom_step[0], settings[i].focus_step[0]}].push_back(settings[i]);
  EXPECT_EQ(nodes.size(), dut.zoom.Steps().size() * dut.focus.Steps().size());
  for (const auto& [node, seen] : nodes) {
    ASSERT_EQ(seen.size(), 2u);
    EXPECT_DOUBLE_EQ(seen[0].pan_rad, -seen[1].pan_rad);
    EXPECT_DOUBLE_EQ(seen[0].tilt_rad, -seen[1].tilt_rad);
    EXPECT_NE(seen[0].pan_rad, 0);
  }
}

TEST(CalibrationPlanTest, TheMechanicsComeFirstAtTheShortestFocalLength) {
  const CalibrationPlan dut;
  const auto settings = dut.Settings();
  std::set<double> pans, tilts, left, right;
  for (std::size_t i = 0; i < 17; ++i) {
    EXPECT_EQ(settings[i].zoom_step[0], dut.zoom.first);
    pans.insert(settings[i].pan_rad);
    tilts.insert(settings[i].tilt_rad);
    left.insert(settings[i].vergence_rad[0]);
    right.insert(settings[i].vergence_rad[1]);
  }
  EXPECT_TRUE(pans.contains(Radians(dut.pan_deg)) && pans.contains(-Radians(dut.pan_deg)));
  EXPECT_TRUE(tilts.contains(Radians(dut.tilt_deg)) && tilts.contains(-Radians(dut.tilt_deg)));
  EXPECT_GE(left.size(), 3u);
  EXPECT_GE(right.size(), 3u);
}

TEST(CalibrationPlanTest, ZoomGoesDownAndTheObjectStaysInTheNarrowPicture) {
  const CalibrationPlan dut;
  const auto settings = dut.Settings();
  for (std::size_t i = 18; i < settings.size(); ++i) {
    EXPECT_LE(settings[i].zoom_step[0], settings[i - 1].zoom_step[0]);
    if (settings[i].zoom_step[0] == dut.zoom.last) {
      EXPECT_LE(std::abs(settings[i].pan_rad), Radians(dut.grid_pan_deg) * dut.grid_tele_share + 1e-12);
    }
  }
}

TEST(CalibrationPlanTest, OneNodeIsAPlan) {
  CalibrationPlan dut;
  dut.zoom = {400, 400, 1};
  dut.focus = {1500, 1500, 1};
  EXPECT_EQ(dut.Settings().size(), 17u + 2);
}

}  // namespace
}  // namespace priamos::head
