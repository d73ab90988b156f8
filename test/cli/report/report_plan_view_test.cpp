#include "cli/report/report_plan_view.hpp"

#include <gmock/gmock.h>

#include <map>
#include <string>

#include "common/config.hpp"
#include "report_synthetic_run.hpp"

namespace priamos::cli {
namespace {

TEST(ReportPlanView, ExtentReachesToTheOuterFacesOfTheWalls) {
  const auto plan = LoadConfig<GroundPlan>(std::string(PRIAMOS_SOURCE_DIR "/config/sim/maps/door.toml"));
  const Extent dut = ExtentOf(plan);
  EXPECT_NEAR((dut.low - Eigen::Vector2d(-0.14, -0.14)).norm(), 0, 1e-9);
  EXPECT_NEAR((dut.high - Eigen::Vector2d(10.14, 4.94)).norm(), 0, 1e-9);
}

TEST(ReportPlanView, PlanWithoutWallsHasAnExtent) {
  EXPECT_GT(ExtentOf(GroundPlan{}).size().minCoeff(), 0);
}

TEST(ReportPlanView, WithoutAPlanTheTrueSolidsAreShownAndThePathAround) {
  const TrueThing wall{"grid 1", {{20, 10}, {30, 10}, {30, 10.1}, {20, 10.1}}};
  RunRecord record;
  for (const double x_m : {25.0, 32.0, 1e9}) {
    world_truth_t truth{};
    truth.x_m = x_m;
    truth.y_m = 8;
    record.truth.push_back(truth);
  }
  const Extent dut = ExtentOfRun({}, {wall}, record);
  EXPECT_NEAR((dut.low - Eigen::Vector2d(20, 7)).norm(), 0, 1e-9);
  EXPECT_NEAR((dut.high - Eigen::Vector2d(33, 10.1)).norm(), 0, 1e-9);
}

TEST(ReportPlanView, FootprintIsTurnedWithTheBase) {
  const auto dut = FootprintOutline({1, 2, kPi / 2}, {0.95, 0.78});
  EXPECT_NEAR((dut[0] - Eigen::Vector2d(1 - 0.39, 2 + 0.475)).norm(), 0, 1e-9);
}

TEST(ReportPlanView, CovarianceIsThatOfThePosition) {
  pose_t pose{};
  pose.sigma_x_m = 0.2;
  pose.sigma_y_m = 0.1;
  pose.rho_x_y = 0.5;
  const Eigen::Matrix2d dut = CovarianceOf(pose);
  EXPECT_NEAR(dut(0, 0), 0.04, 1e-12);
  EXPECT_NEAR(dut(0, 1), 0.01, 1e-12);
}

/// Number of shapes of each layer after `draw` had a view of 10 x 10 m.
template <class Draw>
std::map<std::string, int> Drawn(const Draw& draw) {
  drawing::Drawing page(400, 400, {0xffffff});
  MapView view(page, {0, 0, 400, 400}, {5, 5}, 40);
  draw(view);
  view.SetLabels();
  std::map<std::string, int> drawn;
  for (const auto& shape : page.shapes()) ++drawn[std::string(shape.layer->id)];
  return drawn;
}

TEST(ReportPlanView, JumpOfTheBeliefIsAnArrowNotAPath) {
  const auto with_step = [](double step_m) {
    RunRecord record;
    for (int i = 0; i < 2; ++i) {
      pose_t pose{};
      pose.x_m = 5 + step_m * i;
      pose.y_m = 5;
      Feed(record, Side::kOnboard, i, "POSE", pose);
    }
    return Drawn([&](MapView& view) { DrawBelief(view, record); });
  };
  EXPECT_THAT(with_step(1.0), testing::ElementsAre(testing::Pair("correction", 2)));
  EXPECT_THAT(with_step(0.019), testing::ElementsAre(testing::Pair("belief-path", 1)));
}

TEST(ReportPlanView, LooksWithoutTruthAreLeftOut) {
  RunRecord record = SyntheticRun{}.Record();
  const auto draw = [&](MapView& view) { DrawLooks(view, record, TestDoor()); };
  EXPECT_EQ(Drawn(draw)["look-place"], 2);
  record.truth.clear();
  EXPECT_TRUE(Drawn(draw).empty());
}

TEST(ReportPlanView, EveryContactIsMarkedOnce) {
  RunRecord record;
  for (const int contacts : {0, 1, 1, 2, 2}) {
    world_truth_t truth{};
    truth.x_m = truth.y_m = 3 + contacts;
    truth.contacts = contacts;
    Feed(record, Side::kOnboard, record.truth.size(), "WORLD_TRUTH", truth);
  }
  auto dut = Drawn([&](MapView& view) { DrawContacts(view, record); });
  EXPECT_EQ(dut["contact"], 4);  // two crosses of two lines
  EXPECT_EQ(dut["label"], 2);
}

TEST(ReportPlanView, ThingsHaveTheirNamesUnlessTheyAreTooSmall) {
  const auto square = [](double x, double side) {
    return std::vector<Eigen::Vector2d>{{x, 5}, {x + side, 5}, {x + side, 5 + side}, {x, 5 + side}};
  };
  const std::vector<TrueThing> things{{"carton", square(3, 0.5)}, {"leg", square(6, 0.05)}};
  auto dut = Drawn([&](MapView& view) { DrawThings(view, things, true); });
  EXPECT_EQ(dut["truth-thing"], 2);
  EXPECT_EQ(dut["label"], 1);
}

}  // namespace
}  // namespace priamos::cli
