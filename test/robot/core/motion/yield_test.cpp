#include "robot/core/motion/yield.hpp"

#include <gtest/gtest.h>

namespace priamos::robot {
namespace {

class YieldTest : public testing::Test {
 protected:
  std::optional<double> Step(const std::optional<Comer>& comer, double offset_m = 0, double after_s = 0.1) {
    return dut_.Step(comer, offset_m, 0.4, now_ += FromSeconds(after_s));
  }

  Time now_ = FromUtime(1'000'000);
  Yield dut_{YieldConfig{}};
};

TEST_F(YieldTest, NobodyComesOrNobodyIsNearTheBaseDrivesOn) {
  EXPECT_FALSE(Step(std::nullopt));
  EXPECT_FALSE(Step(Comer{4, 1.2, 0}));
  EXPECT_FALSE(Step(Comer{0.5, 0, 0})) << "who stands is driven around";
}

TEST_F(YieldTest, TheFasterSomebodyComesTheEarlierItMakesRoom) {
  EXPECT_FALSE(Step(Comer{2, 0.5, 0}));
  EXPECT_TRUE(Step(Comer{2, 1.2, 0}));
}

TEST_F(YieldTest, ItGoesToTheRightUnlessSomebodyIsThere) {
  EXPECT_LT(Step(Comer{2, 1.2, 0}).value_or(0), -0.2);
  EXPECT_LT(Step(Comer{1.9, 1.2, -0.3}).value_or(0), -0.2) << "the side is chosen once";
  EXPECT_FALSE(Step(std::nullopt, 0, 3));
  EXPECT_LT(Step(Comer{2, 1.2, -0.3}).value_or(0), -0.2) << "it may be the same one";
  EXPECT_FALSE(Step(std::nullopt, 0, 20));
  EXPECT_GT(Step(Comer{2, 1.2, -0.3}).value_or(0), 0.2);
}

TEST_F(YieldTest, BesideTheWallItStands) {
  EXPECT_NEAR(Step(Comer{2, 1.2, 0}, -0.4).value_or(1), 0, 1e-9);
}

TEST_F(YieldTest, WhoIsNearSeesABaseThatStands) {
  Step(Comer{2, 1.2, 0});
  EXPECT_EQ(Step(Comer{1.1, 1.2, 0}), 0);
  EXPECT_EQ(Step(Comer{0.3, 0, 0}, 0, 4), 0) << "he has stopped, and may turn back";
  EXPECT_FALSE(Step(Comer{0.3, 0, 0}, 0, 5));
}

TEST_F(YieldTest, ItGoesOnAWhileAfterSomebodyHasComeLast) {
  Step(Comer{2, 1.2, 0});
  EXPECT_TRUE(Step(std::nullopt, 0, 1.9));
  EXPECT_FALSE(Step(std::nullopt, 0, 0.2));
}

}  // namespace
}  // namespace priamos::robot
