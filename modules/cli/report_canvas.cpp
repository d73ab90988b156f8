#include "cli/report_canvas.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace priamos::cli {
namespace {

constexpr int kEnlarge = 2;
/// Fractional bits of the coordinates that OpenCV draws with.
constexpr int kShift = 4;
/// Far outside every page, and far inside what fixed point can hold.
constexpr double kFarPx = 20000;
/// Capital letters of OpenCV's Hershey font are this high at scale 1.
constexpr double kCapHeight = 21;

cv::Scalar Bgr(Colour c) {
  return cv::Scalar(c.rgb & 0xff, (c.rgb >> 8) & 0xff, (c.rgb >> 16) & 0xff);
}

int Fixed(double px) {
  return static_cast<int>(std::lround(std::clamp(px, -kFarPx, kFarPx) * kEnlarge * (1 << kShift)));
}

int Thickness(double width) {
  return std::max(1, static_cast<int>(std::lround(width * kEnlarge)));
}

double FontScale(double height) {
  return height * kEnlarge / kCapHeight;
}

int FontThickness(double height, bool bold) {
  return Thickness(std::max(0.5, height * (bold ? 0.16 : 0.09)));
}

}  // namespace

Page::Page(int width_px, int height_px, Colour background)
    : image_(height_px * kEnlarge, width_px * kEnlarge, CV_8UC3, Bgr(background)) {}

void Page::FillBox(double x, double y, double width, double height, Colour colour) {
  const std::vector<cv::Point> corners{{Fixed(x), Fixed(y)},
                                       {Fixed(x + width), Fixed(y)},
                                       {Fixed(x + width), Fixed(y + height)},
                                       {Fixed(x), Fixed(y + height)}};
  cv::fillConvexPoly(image_, corners, Bgr(colour), cv::LINE_AA, kShift);
}

void Page::Text(double x, double y, const std::string& text, double height, Colour colour, bool bold) {
  cv::putText(image_, text, {int(x * kEnlarge), int(y * kEnlarge)}, cv::FONT_HERSHEY_SIMPLEX,
              FontScale(height), Bgr(colour), FontThickness(height, bold), cv::LINE_AA);
}

double Page::TextWidth(const std::string& text, double height, bool bold) const {
  int base_line = 0;
  return double(cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, FontScale(height),
                                FontThickness(height, bold), &base_line)
                    .width) /
         kEnlarge;
}

void Page::Line(double x0, double y0, double x1, double y1, Colour colour, double width) {
  cv::line(image_, {Fixed(x0), Fixed(y0)}, {Fixed(x1), Fixed(y1)}, Bgr(colour), Thickness(width), cv::LINE_AA,
           kShift);
}

cv::Mat Page::Finish() const {
  cv::Mat small;
  cv::resize(image_, small, {}, 1.0 / kEnlarge, 1.0 / kEnlarge, cv::INTER_AREA);
  return small;
}

View::View(Page& page, const cv::Rect& window, const Eigen::Vector2d& centre_m, double px_per_m)
    : window_(page.image_(cv::Rect(window.x * kEnlarge, window.y * kEnlarge, window.width * kEnlarge,
                                   window.height * kEnlarge))),
      centre_m_(centre_m),
      px_per_m_(px_per_m) {}

cv::Point View::ToPixel(const Eigen::Vector2d& in_map) const {
  const Eigen::Vector2d d = (in_map - centre_m_) * px_per_m_;
  return {Fixed(window_.cols / 2.0 / kEnlarge + d.x()), Fixed(window_.rows / 2.0 / kEnlarge - d.y())};
}

std::vector<cv::Point> View::ToPixels(const std::vector<Eigen::Vector2d>& points) const {
  std::vector<cv::Point> pixels;
  for (const auto& point : points) pixels.push_back(ToPixel(point));
  return pixels;
}

void View::Polyline(const std::vector<Eigen::Vector2d>& points, Colour colour, double width, bool closed) {
  if (points.size() < 2) return;
  cv::polylines(window_, ToPixels(points), closed, Bgr(colour), Thickness(width), cv::LINE_AA, kShift);
}

void View::Dashed(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Colour colour, double width) {
  const double dash_m = 7 / px_per_m_, length_m = (to - from).norm();
  for (double at_m = 0; at_m < length_m; at_m += 2 * dash_m) {
    const double end_m = std::min(at_m + dash_m, length_m);
    Polyline({from + (to - from) * at_m / length_m, from + (to - from) * end_m / length_m}, colour, width);
  }
}

void View::Arrow(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Colour colour, double width) {
  const double length_m = (to - from).norm();
  if (length_m <= 0) return;
  const Eigen::Vector2d along = (to - from) / length_m, across(-along.y(), along.x());
  const double head_m = std::min(10 / px_per_m_, length_m / 2);
  Polyline({from, to - along * head_m * 0.8}, colour, width);
  Fill({to, to - along * head_m + across * head_m * 0.45, to - along * head_m - across * head_m * 0.45},
       colour);
}

void View::Fill(const std::vector<Eigen::Vector2d>& polygon, Colour colour, double opacity) {
  if (polygon.size() < 3) return;
  const auto pixels = ToPixels(polygon);
  if (opacity >= 1) {
    cv::fillPoly(window_, std::vector<std::vector<cv::Point>>{pixels}, Bgr(colour), cv::LINE_AA, kShift);
    return;
  }
  // Blended inside the polygon's own bounding box only: whole pages cost more than the drawing.
  cv::Rect box = cv::boundingRect(pixels);
  box = cv::Rect((box.x >> kShift) - 2, (box.y >> kShift) - 2, (box.width >> kShift) + 5,
                 (box.height >> kShift) + 5) &
        cv::Rect(0, 0, window_.cols, window_.rows);
  if (box.empty()) return;
  const cv::Mat before = window_(box).clone();
  cv::fillPoly(window_, std::vector<std::vector<cv::Point>>{pixels}, Bgr(colour), cv::LINE_AA, kShift);
  cv::addWeighted(window_(box), opacity, before, 1 - opacity, 0, window_(box));
}

void View::Dot(const Eigen::Vector2d& at, double radius, Colour colour) {
  cv::circle(window_, ToPixel(at), Fixed(radius), Bgr(colour), cv::FILLED, cv::LINE_AA, kShift);
}

void View::Label(const Eigen::Vector2d& at, double dx, double dy, const std::string& text, double height,
                 Colour colour, bool bold) {
  const cv::Point pixel = ToPixel(at);
  const cv::Point origin{(pixel.x >> kShift) + int(dx * kEnlarge), (pixel.y >> kShift) + int(dy * kEnlarge)};
  cv::putText(window_, text, origin, cv::FONT_HERSHEY_SIMPLEX, FontScale(height), Bgr(colour),
              FontThickness(height, bold), cv::LINE_AA);
}

std::vector<Eigen::Vector2d> EllipseOutline(const Eigen::Vector2d& centre, const Eigen::Matrix2d& covariance,
                                            double sigmas) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(covariance);
  const Eigen::Matrix2d axes =
      solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() * sigmas;
  constexpr int kCorners = 48;
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i < kCorners; ++i) {
    const double turn = 2 * std::numbers::pi * i / kCorners;
    outline.push_back(centre + axes * Eigen::Vector2d(std::cos(turn), std::sin(turn)));
  }
  return outline;
}

}  // namespace priamos::cli
