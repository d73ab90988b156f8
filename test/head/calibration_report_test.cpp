#include "head/calibration_report.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "test/support/head_sweep.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::head {
namespace {

using testing::HasSubstr;

/// Pixels of the residuals' red.
int Red(const cv::Mat& picture) {
  int n = 0;
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const auto& p = picture.at<cv::Vec3b>(y, x);
      n += p[2] > 180 && p[1] < 90 && p[0] < 90;
    }
  }
  return n;
}

class CalibrationReportTest : public testing::Test {
 protected:
  CalibrationReportTest() {
    CalibrationPlan plan;
    plan.zoom.nodes = 2;
    plan.focus.nodes = 2;
    support::SimulatedHead simulated(31);
    views_ = support::Sweep(simulated, plan.Settings(), {}, 31);
    const auto solved = SolveHead(views_);
    if (!solved) throw std::runtime_error(solved.reason());
    result_ = *solved;
  }
  std::string Html() const {
    std::ostringstream text;
    text << std::ifstream(folder_ / "report/index.html").rdbuf();
    return text.str();
  }

  TemporaryFolder folder_;
  std::vector<HeadView> views_;
  HeadCalibration result_;
  ReportedErrors errors_{{321, 0.0004, 0.0005, 0.0012}, HeldOutErrors{7, 0.0345}};
  const HeadSetting at_{0, 0, {-0.02, 0.02}, {600, 600}, {1600, 1600}};
};

TEST_F(CalibrationReportTest, SaysWhatWasMeasured) {
  WriteCalibrationReport(folder_ / "report", views_, result_, errors_, at_);
  const std::string html = Html();
  EXPECT_THAT(html, HasSubstr(std::to_string(views_.size()) + " pictures, " +
                              std::to_string(result_.residuals_px.size()) + " discs"));
  EXPECT_THAT(html,
              HasSubstr("F of 7 settings that took no part 0.0345 px; 321 discs reconstructed by stereo, RMS "
                        "0.50 mm, worst 1.20 mm"));
  for (const char* part : {"F (equation 7)", "Mechanics", "pan axis at", "left camera", "right camera",
                           "third camera", "optical centre C", "focal length c/du", "angle between axes"})
    EXPECT_THAT(html, HasSubstr(part));
  for (const char* picture : {"residuals.png", "errors.png", "curves.png"}) {
    EXPECT_THAT(html, HasSubstr(picture));
    const cv::Mat image = cv::imread(folder_ / (std::string("report/") + picture));
    EXPECT_GT(image.cols, 300) << picture;
  }
}

TEST_F(CalibrationReportTest, LongerResidualsAreLongerLines) {
  WriteCalibrationReport(folder_ / "small", views_, result_, errors_, at_);
  for (Eigen::Vector2d& r : result_.residuals_px) r *= 5;
  WriteCalibrationReport(folder_ / "large", views_, result_, errors_, at_);
  EXPECT_GT(Red(cv::imread(folder_ / "large/residuals.png")),
            2 * Red(cv::imread(folder_ / "small/residuals.png")));
}

TEST_F(CalibrationReportTest, ACameraThatWasNotCalibratedIsNamed) {
  result_.model.lenses[kThird] = LensTable();
  WriteCalibrationReport(folder_ / "report", views_, result_, errors_, at_);
  EXPECT_THAT(Html(), HasSubstr("the lens table is empty"));
}

TEST_F(CalibrationReportTest, AFolderThatCannotBeMadeIsNamed) {
  std::ofstream(folder_ / "file") << "in the way";
  try {
    WriteCalibrationReport(folder_ / "file/report", views_, result_, errors_, at_);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("file/report"));
  }
}

}  // namespace
}  // namespace priamos::head
