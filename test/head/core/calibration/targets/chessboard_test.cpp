#include "head/core/calibration/targets/chessboard.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

namespace priamos::head {
namespace {

using Eigen::Vector2d;

constexpr int kWidth = 400, kHeight = 300;

class ChessboardTest : public testing::Test {
 protected:
  /// Image of the point of the board that is so many squares from its outer corner.
  Vector2d Place(double column, double row) const {
    return Vector2d(60.3, 50.7) + turn_ * (square_px_ * Vector2d(column, row));
  }
  /// The board on white paper; drawn larger and averaged, for edges between pixels.
  GreyImage Photograph() const {
    constexpr int kScale = 4;
    cv::Mat large(kScale * kHeight, kScale * kWidth, CV_8UC1, cv::Scalar(220));
    for (int row = 0; row <= board_.rows; ++row)
      for (int column = row % 2; column <= board_.columns; column += 2) {
        std::vector<cv::Point> square;
        for (const auto& [c, r] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
          const Vector2d at = kScale * (Place(column + c, row + r) + Vector2d(0.5, 0.5)) - Vector2d(0.5, 0.5);
          square.emplace_back(static_cast<int>(std::lround(16 * at.x())),
                              static_cast<int>(std::lround(16 * at.y())));
        }
        cv::fillConvexPoly(large, square, cv::Scalar(30), cv::LINE_8, 4);
      }
    cv::Mat small;
    cv::resize(large, small, {kWidth, kHeight}, 0, 0, cv::INTER_AREA);
    cv::GaussianBlur(small, small, {}, 0.7);
    return {kWidth, kHeight, {small.begin<std::uint8_t>(), small.end<std::uint8_t>()}};
  }
  /// Where a corner of the board's frame was drawn: counting may begin at either end of the board.
  double WorstError(const std::vector<DiscObservation>& observations) const {
    double worst = 1e9;
    for (const bool reversed : {false, true}) {
      double error = 0;
      for (const DiscObservation& o : observations) {
        const double c = o.disc.centre_m.x() / board_.spacing_m, r = o.disc.centre_m.y() / board_.spacing_m;
        const Vector2d at = reversed ? Place(board_.columns - c, board_.rows - r) : Place(c + 1, r + 1);
        error = std::max(error, (o.centroid_px - at).norm());
      }
      worst = std::min(worst, error);
    }
    return worst;
  }

  Chessboard board_{.columns = 7, .rows = 4, .spacing_m = 0.03};
  double square_px_ = 30;
  Eigen::Rotation2Dd turn_{0.1};
};

TEST_F(ChessboardTest, FindsEveryInnerCornerToATenthOfAPixel) {
  const auto dut = FindCorners(Photograph(), board_);
  ASSERT_TRUE(dut) << dut.reason();
  ASSERT_EQ(dut->size(), 28u);
  EXPECT_LT(WorstError(*dut), 0.1);
}

TEST_F(ChessboardTest, CornersArePointsOfAGridInTheBoardsPlane) {
  const auto dut = FindCorners(Photograph(), board_);
  ASSERT_TRUE(dut) << dut.reason();
  for (int i = 0; i < 28; ++i) {
    const DiscObservation& o = (*dut)[i];
    EXPECT_LT((o.disc.centre_m - Eigen::Vector3d(0.03 * (i % 7), 0.03 * (i / 7), 0)).norm(), 1e-12) << i;
    EXPECT_EQ(o.disc.radius_m, 0) << "without extent there is no bias";
    EXPECT_GT(o.sigma_px, 0);
  }
}

TEST_F(ChessboardTest, SmallSquaresAreToldApart) {
  square_px_ = 12;
  const auto dut = FindCorners(Photograph(), board_);
  ASSERT_TRUE(dut) << dut.reason();
  EXPECT_LT(WorstError(*dut), 0.2) << "the window of a corner must not hold the next one";
}

TEST_F(ChessboardTest, ABoardThatIsNotThereAsAWholeIsRefused) {
  const GreyImage blank{kWidth, kHeight, std::vector<std::uint8_t>(kWidth * kHeight, 200)};
  EXPECT_EQ(FindCorners(blank, board_).reason(), "no chessboard of 7 by 4 inner corners");
  GreyImage covered = Photograph();
  for (int v = 0; v < kHeight; ++v)
    for (int u = 180; u < kWidth; ++u) covered.pixels[v * kWidth + u] = 220;
  EXPECT_EQ(FindCorners(covered, board_).reason(), "no chessboard of 7 by 4 inner corners");
  const Chessboard other{.columns = 9, .rows = 6};
  EXPECT_EQ(FindCorners(Photograph(), other).reason(), "no chessboard of 9 by 6 inner corners");
}

}  // namespace
}  // namespace priamos::head
