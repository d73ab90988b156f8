#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "common/drawing/box.hpp"
#include "common/drawing/text_extent.hpp"

namespace priamos::drawing {

/// A colour as people write it, 0xRRGGBB.
struct Colour {
  unsigned rgb = 0;
};

/// Appearance of lines and areas.
struct Style {
  std::optional<Colour> line{};
  double width = 1;  ///< width of the line [px]
  double dash = 0;   ///< length of a dash and of a gap [px]; 0: a solid line
  std::optional<Colour> fill{};
  double opacity = 1;  ///< opacity of the fill: 1 covers, 0 is invisible
};

/// The sample of a layer in the legend.
enum class Symbol { kLine, kArea, kDot, kArrow, kEllipse, kCross };

/// One kind of thing in a drawing. Layers are constants of the code that draws; shapes refer to them.
struct Layer {
  std::string_view id;       ///< class of the group in SVG
  std::string_view meaning;  ///< text in the legend; empty: no entry (grid, frame, text)
  Style style{};
  Symbol symbol = Symbol::kLine;
};

/// Points joined by straight lines [px of the page].
struct Path {
  std::vector<Eigen::Vector2d> points;
  bool closed = false;
};

/// A circle [px of the page].
struct Circle {
  Eigen::Vector2d centre;
  double radius = 0;
};

/// One line of text from the point `at` on its base line to the right.
struct Text {
  Eigen::Vector2d at;
  std::string text;
  Font font;
  Colour colour;
  TextExtent extent;

  Box box() const { return {at.x(), at.y() - extent.ascent, extent.width, extent.height()}; }
};

/// One form with its style, on a layer or on none.
struct Shape {
  const Layer* layer = nullptr;
  Style style;
  std::variant<Path, Circle, Text> form;
  std::optional<Box> clip{};  ///< the form is cut to this box
};

/// A page as a list of shapes, the first lowest: x right, y down, in pixels of a screen at scale 1. It is
/// painted by `Paint` (Cairo) and written by `ToSvg`; both show the same. Shapes that are not finite are left
/// out, so that no damaged number ruins a picture.
class Drawing {
 public:
  Drawing(double width, double height, Colour background)
      : width_(width), height_(height), background_(background) {}

  void Add(const Layer& layer, std::variant<Path, Circle, Text> form, const std::optional<Box>& clip = {});
  /// Adds a form with another style than the layer's usual one.
  void Add(const Layer& layer, const Style& style, std::variant<Path, Circle, Text> form,
           const std::optional<Box>& clip = {});
  void Line(const Layer& layer, const Eigen::Vector2d& from, const Eigen::Vector2d& to);
  void FillBox(const Layer& layer, const Box& box);
  /// Adds a line of text. Returns the box that it covers.
  Box Write(const Layer& layer, const Eigen::Vector2d& at, const std::string& text, const Font& font,
            Colour colour);

  double width() const { return width_; }
  double height() const { return height_; }
  Colour background() const { return background_; }
  const std::vector<Shape>& shapes() const { return shapes_; }
  /// Layers that have a meaning and shapes on the page, in the order in which they were first drawn.
  std::vector<const Layer*> LayersToExplain() const;
  /// A page may grow while it is drawn.
  void SetHeight(double height) { height_ = height; }

 private:
  double width_, height_;
  Colour background_;
  std::vector<Shape> shapes_;
};

/// An arrow as two shapes: its line and its head, of `head` pixels or half its length.
void AddArrow(Drawing& drawing, const Layer& layer, const Style& style, const Eigen::Vector2d& from,
              const Eigen::Vector2d& to, double head, const std::optional<Box>& clip = {});

}  // namespace priamos::drawing
