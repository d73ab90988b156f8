#include "head/core/look/glance_evaluator.hpp"

#include <gtest/gtest.h>

namespace priamos::head {
namespace {

HeadModel Calibrated() {
  HeadModel model;
  for (LensTable& lens : model.lenses)
    lens = LensTable({650}, {1600}, {{1000, {383.5, 287.5}, -0.05, 0, 0.02}});
  return model;
}

const HeadSetting kSetting{0, 0, {-0.02, 0.02}, {650, 650}, {1600, 1600}};

GreyImage Black(int width = 768, int height = 576) {
  return {width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(width) * height, 0)};
}

TEST(GlanceEvaluator, BlackPicturesShowNoDoor) {
  GlanceEvaluator dut(Calibrated(), {});
  EXPECT_TRUE(dut.Evaluate({Black(), Black()}, kSetting).empty());
}

TEST(GlanceEvaluator, WithoutBothPicturesOrACalibrationThereIsNone) {
  GlanceEvaluator dut(Calibrated(), {});
  EXPECT_TRUE(dut.Evaluate({Black(), std::nullopt}, kSetting).empty());
  EXPECT_TRUE(dut.Evaluate({Black(32, 32), Black()}, kSetting).empty());
  HeadSetting elsewhere = kSetting;
  elsewhere.zoom_step = {100, 100};
  EXPECT_TRUE(dut.Evaluate({Black(), Black()}, elsewhere).empty());
}

}  // namespace
}  // namespace priamos::head
