#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "common/drawing/drawing.hpp"
#include "common/drawing/label_layout.hpp"
#include "common/rectangle.hpp"

namespace priamos::cli {

/// A window of a page that shows a part of the floor (map frame: x right, y up), clipped at its border.
/// Labels are gathered and set at the end, where they cover neither each other nor, if it can be helped, a
/// line.
class MapView {
 public:
  /// The window on the page [px]; the map point in its middle; its scale.
  MapView(drawing::Drawing& page, const drawing::Box& window, const Eigen::Vector2d& centre_m,
          double px_per_m);

  Eigen::Vector2d ToPage(const Eigen::Vector2d& in_map) const;
  const drawing::Box& window() const { return window_; }

  /// A line; labels keep off what has a meaning.
  void Line(const drawing::Layer& layer, const std::vector<Eigen::Vector2d>& points);
  /// A closed outline with the layer's fill; labels may stand inside. Of many that lie on each other each may
  /// be fainter than the layer.
  void Area(const drawing::Layer& layer, const std::vector<Eigen::Vector2d>& corners, double opacity = 1);
  /// An area that no label covers, such as a wall.
  void Solid(const drawing::Layer& layer, const Rectangle& shape);
  void Arrow(const drawing::Layer& layer, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
             double head_px);
  /// A dot that no label covers.
  void Dot(const drawing::Layer& layer, const Eigen::Vector2d& at, double radius_px);
  void Cross(const drawing::Layer& layer, const Eigen::Vector2d& at, double radius_px);
  /// Writes a label at least `distance_px` [px] from the point; a centred label stands on it if it can.
  void Label(const Eigen::Vector2d& at, const std::string& text, const drawing::Font& font,
             drawing::Colour colour, double distance_px, bool centred = false);
  /// The name of an area: on it where it fits, else beside it.
  void Name(const std::vector<Eigen::Vector2d>& corners, const std::string& text, const drawing::Font& font,
            drawing::Colour colour);
  /// No label covers this part of the page.
  void KeepClear(const drawing::Box& box) { around_.taken.push_back(box); }
  /// Sets the gathered labels, the first first; a thin line leads from what stands far off to its point.
  void SetLabels();

 private:
  struct Wish {
    std::string text;
    drawing::Font font;
    drawing::Colour colour;
    drawing::TextExtent extent;
  };
  void KeepOff(const std::vector<Eigen::Vector2d>& line_px);
  void Lead(const Eigen::Vector2d& at_px, const drawing::Box& to, double near_px);

  drawing::Drawing& page_;
  drawing::Box window_;
  Eigen::Vector2d centre_m_;
  double px_per_m_;
  drawing::Surroundings around_;
  std::vector<Wish> texts_;
  std::vector<drawing::LabelWish> wishes_;
};

/// Outline of the ellipse that holds `sigmas` standard deviations of a 2x2 covariance.
std::vector<Eigen::Vector2d> EllipseOutline(const Eigen::Vector2d& centre, const Eigen::Matrix2d& covariance,
                                            double sigmas);

}  // namespace priamos::cli
