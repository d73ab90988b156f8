#include "head/see_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace priamos::head {
namespace {

constexpr int kShift = 4;  // OpenCV takes sub-pixel points in 1/16 px
constexpr double kNear_m = 0.8, kFar_m = 12;

cv::Point Fixed(const Eigen::Vector2d& p) {
  return {static_cast<int>(std::lround(p.x() * (1 << kShift))),
          static_cast<int>(std::lround(p.y() * (1 << kShift)))};
}

cv::Mat Dimmed(const cv::Mat& grey) {
  cv::Mat canvas;
  cv::cvtColor(grey * 0.6 + 60, canvas, cv::COLOR_GRAY2BGR);
  return canvas;
}

void Line(cv::Mat& canvas, const EdgeSegment& s, const cv::Scalar& colour, int width) {
  cv::line(canvas, Fixed(s.begin), Fixed(s.end), colour, width, cv::LINE_AA, kShift);
}

/// A door shows at a glance.
cv::Scalar ColourOf(const EdgeSegment& segment) {
  const Eigen::Vector2d d = segment.direction().cwiseAbs();
  constexpr double kNearlyAxis = 0.1;
  if (d.x() < kNearlyAxis) return {60, 200, 60};
  if (d.y() < kNearlyAxis) return {230, 140, 40};
  return {40, 140, 250};
}

void FillParallelograms(cv::Mat& canvas, const ContourGraph& contours) {
  cv::Mat filled = canvas.clone();
  for (const Polygon& polygon : contours.polygons()) {
    if (!polygon.is_parallelogram) continue;
    std::vector<cv::Point> outline;
    for (const auto& p : contours.Outline(polygon)) outline.push_back(Fixed(p));
    cv::fillConvexPoly(filled, outline, {200, 120, 220}, cv::LINE_AA, kShift);
  }
  cv::addWeighted(filled, 0.35, canvas, 0.65, 0, canvas);
}

/// Hue by inverse distance, as disparity pictures have it.
cv::Scalar ColourOf(const StereoMatch& match, const CameraModel& camera) {
  if (!match.space) return {255, 255, 255};
  const double depth = MetricDepth(camera, 0.5 * (match.space->from + match.space->to));
  const double far = (1 / kNear_m - 1 / std::clamp(depth, kNear_m, kFar_m)) / (1 / kNear_m - 1 / kFar_m);
  const cv::Mat hsv(1, 1, CV_8UC3, cv::Scalar(120 * far, 255, 255));
  cv::Mat bgr;
  cv::cvtColor(hsv, bgr, cv::COLOR_HSV2BGR);
  const auto c = bgr.at<cv::Vec3b>(0, 0);
  return {double(c[0]), double(c[1]), double(c[2])};
}

}  // namespace

cv::Mat DrawContours(const cv::Mat& grey, const EdgeImage& edges, const ContourGraph& contours) {
  cv::Mat canvas = Dimmed(grey);
  FillParallelograms(canvas, contours);
  for (const EdgeSegment& s : edges.segments) Line(canvas, s, ColourOf(s), 2);
  for (const Corner& corner : contours.corners())
    cv::circle(canvas, Fixed(corner.at), 3 << kShift, {40, 40, 230}, 1, cv::LINE_AA, kShift);
  return canvas;
}

cv::Mat DrawMatches(std::span<const cv::Mat> greys, std::span<const CameraView> views,
                    std::span<const StereoMatch> matches) {
  std::vector<cv::Mat> canvases;
  for (std::size_t i = 0; i < greys.size(); ++i) {
    canvases.push_back(Dimmed(greys[i]));
    for (const EdgeSegment& s : views[i].edges->segments) Line(canvases[i], s, {150, 150, 150}, 1);
  }
  const auto segment = [&](std::size_t view, int line) -> const EdgeSegment& {
    return views[view].edges->segments[views[view].lines[line].segment];
  };
  for (const StereoMatch& match : matches) {
    const cv::Scalar colour = ColourOf(match, *views[0].camera);
    Line(canvases[0], segment(0, match.left), colour, 2);
    for (const int line : match.right) Line(canvases[1], segment(1, line), colour, 2);
    for (const int line : match.third) Line(canvases[2], segment(2, line), colour, 2);
  }
  cv::Mat all;
  cv::hconcat(canvases, all);
  return all;
}

}  // namespace priamos::head
