#pragma once

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <vector>

#include "head/core/bodies/polyhedron.hpp"
#include "head/core/edges/step_meter.hpp"
#include "test/head/core/bodies/grey_cupboard.hpp"

namespace priamos::test {

/// The cupboard before one camera, blurred; its view has no edges of the operator.
class BlurredCupboard : public testing::Test {
 protected:
  static constexpr double kBlur_px = 3;

  BlurredCupboard() {
    image_ = RenderQuads(cupboard_.quads, truth_, camera_, 1, rng_, 60);
    cv::GaussianBlur(image_, image_, {0, 0}, kBlur_px);
    edges_.width = image_.cols;
    edges_.height = image_.rows;
    view_ = head::MakeView(camera_, edges_);
    view_.blur_px = kBlur_px;
    meters_.emplace_back(image_, 1, kBlur_px);
  }

  Rng rng_{3};
  const head::CameraModel camera_ = HeadCamera(0, 1, 700);
  const GreyCupboard cupboard_;
  const Eigen::Isometry3d truth_{Eigen::Translation3d(2.6, -0.4, 0.2) *
                                 Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ())};
  cv::Mat image_;
  head::EdgeImage edges_;  ///< empty: no edge was linked
  head::CameraView view_;
  std::vector<head::StepMeter> meters_;
};

}  // namespace priamos::test
