#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace priamos::cli {

/// A colour as people write it, 0xRRGGBB.
struct Colour {
  unsigned rgb = 0;
};

/// A page of pixels (x right, y down) on which smooth lines are drawn: everything is painted four times as
/// large in area and averaged at the end, so that thin lines, text and fills are equally smooth.
class Page {
 public:
  Page(int width_px, int height_px, Colour background);

  void FillBox(double x, double y, double width, double height, Colour colour);
  /// `height` is that of a capital letter; the text begins at x, its base line is at y.
  void Text(double x, double y, const std::string& text, double height, Colour colour, bool bold = false);
  double TextWidth(const std::string& text, double height, bool bold = false) const;
  void Line(double x0, double y0, double x1, double y1, Colour colour, double width);
  /// The finished picture.
  cv::Mat Finish() const;

 private:
  friend class View;
  cv::Mat image_;
};

/// A window of a page that shows a part of the floor (map frame: x right, y up), clipped at its border.
class View {
 public:
  /// The window's corner and size on the page [px]; the map point in its middle; its scale.
  View(Page& page, const cv::Rect& window, const Eigen::Vector2d& centre_m, double px_per_m);

  void Polyline(const std::vector<Eigen::Vector2d>& points, Colour colour, double width, bool closed = false);
  /// Dashes of equal length on the page.
  void Dashed(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Colour colour, double width);
  void Arrow(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Colour colour, double width);
  /// opacity 1 covers, 0 is invisible.
  void Fill(const std::vector<Eigen::Vector2d>& polygon, Colour colour, double opacity = 1);
  /// radius in pixels.
  void Dot(const Eigen::Vector2d& at, double radius, Colour colour);
  void Label(const Eigen::Vector2d& at, double dx, double dy, const std::string& text, double height,
             Colour colour, bool bold = false);
  double px_per_m() const { return px_per_m_; }

 private:
  /// Pixels of the enlarged window in fixed point.
  cv::Point ToPixel(const Eigen::Vector2d& in_map) const;
  std::vector<cv::Point> ToPixels(const std::vector<Eigen::Vector2d>& points) const;

  cv::Mat window_;
  Eigen::Vector2d centre_m_;
  double px_per_m_;
};

/// Outline of the ellipse that holds `sigmas` standard deviations of a 2x2 covariance.
std::vector<Eigen::Vector2d> EllipseOutline(const Eigen::Vector2d& centre, const Eigen::Matrix2d& covariance,
                                            double sigmas);

}  // namespace priamos::cli
