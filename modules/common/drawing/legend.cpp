#include "common/drawing/legend.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace priamos::drawing {
namespace {

using Eigen::Vector2d;

/// Sizes of the font that a sample and its gap take.
constexpr double kSample = 1.6, kGap = 0.5, kBetween = 1.2;

Path Outline(const Box& b) {
  return {{{b.x, b.y}, {b.right(), b.y}, {b.right(), b.bottom()}, {b.x, b.bottom()}}, true};
}

Path Ellipse(const Box& field) {
  constexpr int kCorners = 32;
  Path outline{{}, true};
  for (int i = 0; i < kCorners; ++i) {
    const double turn = 2 * std::numbers::pi * i / kCorners;
    outline.points.push_back(field.middle() +
                             Vector2d(std::cos(turn) * field.width, std::sin(turn) * field.height) / 2);
  }
  return outline;
}

/// A sample of the layer in the middle of a field.
void DrawSample(Drawing& drawing, const Layer& layer, double widen, const Box& field) {
  const Vector2d middle = field.middle(), left(field.x, middle.y()), right(field.right(), middle.y());
  Style style = layer.style;
  style.width *= widen;
  style.dash *= widen;
  switch (layer.symbol) {
    case Symbol::kLine:
      return drawing.Add(layer, style, Path{{left, right}, false});
    case Symbol::kArrow:
      return AddArrow(drawing, layer, style, left, right, field.height * 0.7);
    case Symbol::kArea:
      return drawing.Add(layer, style, Outline(field));
    case Symbol::kDot:
      return drawing.Add(layer, style, Circle{middle, field.height * 0.35});
    case Symbol::kEllipse:
      return drawing.Add(layer, style, Ellipse(field));
    case Symbol::kCross: {
      const Vector2d d(field.height / 2, field.height / 2), e(d.x(), -d.y());
      drawing.Add(layer, style, Path{{middle - d, middle + d}, false});
      return drawing.Add(layer, style, Path{{middle - e, middle + e}, false});
    }
  }
}

}  // namespace

double WriteLegend(Drawing& drawing, double x, double y, double width, const LegendLook& look) {
  static constexpr Layer kText{"legend", ""};
  const auto layers = drawing.LayersToExplain();
  if (layers.empty()) return 0;
  const double size = look.font.size, row = size * look.leading, indent = size * (kSample + kGap);
  double widest = 0;
  for (const Layer* layer : layers)
    widest = std::max(widest, indent + MeasureText(std::string(layer->meaning), look.font).width);
  const double between = size * kBetween;
  const int columns = std::max(1, static_cast<int>((width + between) / (widest + between)));
  const int n = static_cast<int>(layers.size()), rows = (n + columns - 1) / columns;
  for (int i = 0; i < n; ++i) {
    const int column = i / rows;
    const double left = x + column * (widest + between), top = y + i % rows * row;
    DrawSample(drawing, *layers[static_cast<std::size_t>(i)], look.widen,
               {left, top + row / 2 - size * 0.35, size * kSample, size * 0.7});
    drawing.Write(kText, {left + indent, top + row / 2 + size * 0.36},
                  std::string(layers[static_cast<std::size_t>(i)]->meaning), look.font, look.ink);
  }
  return rows * row;
}

}  // namespace priamos::drawing
