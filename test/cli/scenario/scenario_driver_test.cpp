#include "cli/scenario/scenario_driver.hpp"

#include <gtest/gtest.h>

namespace priamos::cli {
namespace {

TEST(LookTextTest, AFixSaysWhatItRestsOnAndHowSureItIs) {
  landmark_fix_t look{};
  look.side = 1;
  look.n_matched = 24;
  look.sigma_x_m = 0.003;
  look.sigma_y_m = 0.004;
  look.sigma_yaw_rad = 0.01;
  EXPECT_EQ(LookText(look), "  left side found: 24 edges, 1 sigma 0.5 cm and 0.57 degrees");
}

TEST(LookTextTest, AFailureSaysWhy) {
  landmark_fix_t look{};
  look.side = 2;
  look.verdict = landmark_fix_t::TOO_FEW_EDGES;
  EXPECT_EQ(LookText(look), "  right side not found: too few edges");
}

TEST(LookTextTest, AnUnknownSideIsNoReasonToFall) {
  landmark_fix_t look{};
  look.verdict = landmark_fix_t::NO_IMAGE;
  for (const int side : {-128, -1, 3, 127}) {
    look.side = static_cast<std::int8_t>(side);
    EXPECT_NE(LookText(look).find("not found: no image"), std::string::npos);
  }
}

}  // namespace
}  // namespace priamos::cli
