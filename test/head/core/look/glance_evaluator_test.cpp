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

bool IsEmpty(const Glance& glance) {
  return glance.doors.empty() && glance.scene.objects.empty();
}

TEST(GlanceEvaluator, BlackPicturesShowNothing) {
  GlanceEvaluator dut(Calibrated(), {});
  EXPECT_TRUE(IsEmpty(dut.Evaluate({Black(), Black()}, kSetting, true)));
}

TEST(GlanceEvaluator, WithoutBothPicturesOrACalibrationThereIsNone) {
  GlanceEvaluator dut(Calibrated(), {});
  EXPECT_TRUE(IsEmpty(dut.Evaluate({Black(), std::nullopt}, kSetting, true)));
  EXPECT_TRUE(IsEmpty(dut.Evaluate({Black(32, 32), Black()}, kSetting, true)));
  HeadSetting elsewhere = kSetting;
  elsewhere.zoom_step = {100, 100};
  EXPECT_TRUE(IsEmpty(dut.Evaluate({Black(), Black()}, elsewhere, true)));
}

}  // namespace
}  // namespace priamos::head
