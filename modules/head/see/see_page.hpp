#pragma once

#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

#include "common/drawing/drawing.hpp"
#include "common/drawing/label_layout.hpp"

namespace priamos::head {

/// Photographs side by side, dimmed, with what was seen in them, and below them the legend of all that was
/// drawn. Lines, marks and text grow with the images: layers give widths for 640 x 480 pixels.
class SeePage {
 public:
  /// Grey images of equal height.
  explicit SeePage(std::span<const cv::Mat> greys);

  /// Places are pixels of the image with that number (x right, y down, the centre of the first at (0, 0)).
  void Line(const drawing::Layer& layer, std::size_t image, const Eigen::Vector2d& from,
            const Eigen::Vector2d& to);
  void Area(const drawing::Layer& layer, std::size_t image, std::vector<Eigen::Vector2d> corners);
  /// A ring of `radius` pixels of 640 x 480.
  void Ring(const drawing::Layer& layer, std::size_t image, const Eigen::Vector2d& centre, double radius);
  /// A short text near a point, off all other texts, as far as there is room for it.
  void Label(std::size_t image, const Eigen::Vector2d& at, const std::string& text, drawing::Colour colour);

  /// Sets labels and legend; nothing may be drawn after it.
  void Finish();
  const drawing::Drawing& drawing() const { return drawing_; }
  /// The finished page as the bytes of a PNG file.
  std::string ToPng() const;

 private:
  Eigen::Vector2d OnPage(std::size_t image, const Eigen::Vector2d& at) const;
  drawing::Style Grown(const drawing::Style& style) const;

  struct Name {
    std::string text;
    drawing::Colour colour;
    drawing::TextExtent extent;
  };

  std::vector<cv::Mat> greys_;
  std::vector<double> left_;  ///< left border of each image on the page
  double unit_;               ///< pixels of the images per pixel of 640 x 480
  drawing::Drawing drawing_;
  drawing::Font font_;
  std::vector<Name> names_;
  std::vector<drawing::LabelWish> wishes_;
};

}  // namespace priamos::head
