#include "head/core/calibration/targets/chessboard.hpp"

#include <fmt/format.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace priamos::head {
namespace {

constexpr double kCornerSigma_px = 0.1;  // of corners of printed squares
constexpr int kWidest_px = 11;           // half of the widest window that a corner is refined in

/// A third of the smallest distance between neighbouring corners: the window must not hold a second one.
int WindowFor(const std::vector<cv::Point2f>& corners, int columns) {
  double nearest = 1e9;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    if (i % columns != 0) nearest = std::min(nearest, cv::norm(corners[i] - corners[i - 1]));
  }
  return std::clamp(static_cast<int>(nearest / 3), 2, kWidest_px);
}

}  // namespace

Outcome<std::vector<DiscObservation>> FindCorners(const GreyImage& photograph, const Chessboard& board) {
  const cv::Mat image(photograph.height, photograph.width, CV_8UC1,
                      const_cast<std::uint8_t*>(photograph.pixels.data()));
  std::vector<cv::Point2f> corners;
  if (!cv::findChessboardCorners(image, {board.columns, board.rows}, corners))
    return Refusal{fmt::format("no chessboard of {} by {} inner corners", board.columns, board.rows)};
  const int window = WindowFor(corners, board.columns);
  cv::cornerSubPix(image, corners, {window, window}, {-1, -1},
                   {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 60, 1e-3});
  std::vector<DiscObservation> observations;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const int column = static_cast<int>(i) % board.columns, row = static_cast<int>(i) / board.columns;
    const Eigen::Vector3d at(column * board.spacing_m, row * board.spacing_m, 0);
    observations.push_back(
        {{at, Eigen::Vector3d::UnitZ(), 0}, {corners[i].x, corners[i].y}, kCornerSigma_px});
  }
  return observations;
}

}  // namespace priamos::head
