#include "head/see/see_page.hpp"

#include <algorithm>
#include <cmath>

#include "common/drawing/legend.hpp"
#include "common/drawing/raster.hpp"

namespace priamos::head {
namespace {

using Eigen::Vector2d;

constexpr drawing::Colour kPaper{0x22282e}, kInk{0xf4f4f4};
constexpr drawing::Layer kLabels{"label", ""};
constexpr double kThinnest_px = 0.8, kSmallestText_px = 11;
/// Size of text as a share of the page's width, so that it can be read on a telephone.
constexpr double kTextShare = 0.024;

double WidthOf(std::span<const cv::Mat> greys) {
  double width = 0;
  for (const cv::Mat& grey : greys) width += grey.cols;
  return width;
}

/// The image in the middle greys, so that every colour stands out.
std::uint32_t Dimmed(unsigned char grey) {
  const auto level = static_cast<std::uint32_t>(0.6 * grey + 50);
  return level << 16 | level << 8 | level;
}

}  // namespace

SeePage::SeePage(std::span<const cv::Mat> greys)
    : greys_(greys.begin(), greys.end()),
      unit_(std::hypot(greys_.at(0).cols, greys_.at(0).rows) / std::hypot(640, 480)),
      drawing_(WidthOf(greys), greys_.at(0).rows, kPaper),
      font_{std::max(kSmallestText_px, kTextShare * WidthOf(greys)), false} {
  double left = 0;
  for (const cv::Mat& grey : greys_) {
    left_.push_back(left);
    left += grey.cols;
  }
}

Vector2d SeePage::OnPage(std::size_t image, const Vector2d& at) const {
  return at +
         Vector2d(left_.at(image) + 0.5, 0.5);  // the first pixel's centre is half a pixel from the corner
}

drawing::Style SeePage::Grown(const drawing::Style& style) const {
  drawing::Style grown = style;
  grown.width = std::max(kThinnest_px, style.width * unit_);
  grown.dash = style.dash * unit_;
  return grown;
}

void SeePage::Line(const drawing::Layer& layer, std::size_t image, const Vector2d& from, const Vector2d& to) {
  drawing_.Add(layer, Grown(layer.style), drawing::Path{{OnPage(image, from), OnPage(image, to)}, false},
               drawing::Box{left_.at(image), 0, double(greys_[image].cols), double(greys_[image].rows)});
}

void SeePage::Area(const drawing::Layer& layer, std::size_t image, std::vector<Vector2d> corners) {
  for (Vector2d& corner : corners) corner = OnPage(image, corner);
  drawing_.Add(layer, Grown(layer.style), drawing::Path{std::move(corners), true},
               drawing::Box{left_.at(image), 0, double(greys_[image].cols), double(greys_[image].rows)});
}

void SeePage::Ring(const drawing::Layer& layer, std::size_t image, const Vector2d& centre, double radius) {
  drawing_.Add(layer, Grown(layer.style),
               drawing::Circle{OnPage(image, centre), std::max(1.5, radius * unit_)});
}

void SeePage::Label(std::size_t image, const Vector2d& at, const std::string& text, drawing::Colour colour) {
  names_.push_back({text, colour, drawing::MeasureText(text, font_)});
  const auto& extent = names_.back().extent;
  wishes_.push_back({OnPage(image, at), extent.width, extent.height(), 3 * unit_, false});
}

void SeePage::Finish() {
  const double images = drawing_.height(), margin = font_.size;
  const auto places = drawing::PlaceLabels(wishes_, {{0, 0, drawing_.width(), images}, {}, {}});
  for (std::size_t i = 0; i < places.size(); ++i)
    if (places[i])
      drawing_.Write(kLabels, {places[i]->x, places[i]->y + names_[i].extent.ascent}, names_[i].text, font_,
                     names_[i].colour);
  const double legend =
      drawing::WriteLegend(drawing_, margin, images + margin / 2, drawing_.width() - 2 * margin,
                           {font_, kInk, std::max(1.0, unit_)});
  drawing_.SetHeight(images + (legend > 0 ? std::ceil(legend + margin) : 0));
}

std::string SeePage::ToPng() const {
  drawing::Raster raster(static_cast<int>(drawing_.width()), static_cast<int>(drawing_.height()), kPaper);
  for (std::size_t i = 0; i < greys_.size(); ++i)
    for (int y = 0; y < greys_[i].rows; ++y)
      for (int x = 0; x < greys_[i].cols; ++x)
        raster.At(static_cast<int>(left_[i]) + x, y) = Dimmed(greys_[i].at<unsigned char>(y, x));
  drawing::Paint(drawing_, 1, raster);
  return drawing::ToPng(raster);
}

}  // namespace priamos::head
