#include "common/drawing/drawing.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::drawing {
namespace {

/// Far outside every page, and far inside what a painter can hold.
constexpr double kFar_px = 1e5;

bool Drawable(const Eigen::Vector2d& point) {
  return point.allFinite() && point.cwiseAbs().maxCoeff() < kFar_px;
}

bool Drawable(const Path& path) {
  return !path.points.empty() &&
         std::all_of(path.points.begin(), path.points.end(), [](const auto& p) { return Drawable(p); });
}
bool Drawable(const Circle& circle) {
  return Drawable(circle.centre) && std::isfinite(circle.radius) && circle.radius < kFar_px;
}
bool Drawable(const Text& text) {
  return Drawable(text.at) && !text.text.empty();
}

}  // namespace

void Drawing::Add(const Layer& layer, std::variant<Path, Circle, Text> form, const std::optional<Box>& clip) {
  Add(layer, layer.style, std::move(form), clip);
}

void Drawing::Add(const Layer& layer, const Style& style, std::variant<Path, Circle, Text> form,
                  const std::optional<Box>& clip) {
  if (std::visit([](const auto& shape) { return Drawable(shape); }, form))
    shapes_.push_back({&layer, style, std::move(form), clip});
}

void Drawing::Line(const Layer& layer, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  Add(layer, Path{{from, to}, false});
}

void Drawing::FillBox(const Layer& layer, const Box& b) {
  Add(layer, Path{{{b.x, b.y}, {b.right(), b.y}, {b.right(), b.bottom()}, {b.x, b.bottom()}}, true});
}

Box Drawing::Write(const Layer& layer, const Eigen::Vector2d& at, const std::string& text, const Font& font,
                   Colour colour) {
  const Text line{at, text, font, colour, MeasureText(text, font)};
  Add(layer, line);
  return line.box();
}

std::vector<const Layer*> Drawing::LayersToExplain() const {
  std::vector<const Layer*> layers;
  for (const Shape& shape : shapes_)
    if (!shape.layer->meaning.empty() && std::find(layers.begin(), layers.end(), shape.layer) == layers.end())
      layers.push_back(shape.layer);
  return layers;
}

void AddArrow(Drawing& drawing, const Layer& layer, const Style& style, const Eigen::Vector2d& from,
              const Eigen::Vector2d& to, double head, const std::optional<Box>& clip) {
  const double length = (to - from).norm();
  if (!(length > 0)) return;
  const Eigen::Vector2d along = (to - from) / length, across(-along.y(), along.x());
  head = std::min(head, length / 2);
  const Eigen::Vector2d neck = to - along * head;
  drawing.Add(layer, style, Path{{from, neck + along * head * 0.2}, false}, clip);
  Style solid = style;
  solid.fill = style.line;
  solid.line.reset();
  solid.opacity = 1;
  drawing.Add(layer, solid, Path{{to, neck + across * head * 0.45, neck - across * head * 0.45}, true}, clip);
}

}  // namespace priamos::drawing
