#include "common/drawing/svg.hpp"

#include <fmt/format.h>

namespace priamos::drawing {
namespace {

std::string ColourText(const std::optional<Colour>& colour) {
  return colour ? fmt::format("#{:06x}", colour->rgb & 0xffffff) : "none";
}

/// The attributes of lines and areas.
std::string Look(const Style& style) {
  std::string look = fmt::format(" fill=\"{}\"", ColourText(style.fill));
  if (style.fill && style.opacity < 1) look += fmt::format(" fill-opacity=\"{:.3g}\"", style.opacity);
  if (!style.line) return look;
  look += fmt::format(" stroke=\"{}\" stroke-width=\"{:.4g}\"", ColourText(style.line), style.width);
  if (style.dash > 0) look += fmt::format(" stroke-dasharray=\"{:.4g}\"", style.dash);
  return look;
}

std::string Form(const Style& style, const Path& path) {
  std::string points;
  for (const auto& p : path.points)
    points += fmt::format("{}{:.1f},{:.1f}", points.empty() ? "" : " ", p.x(), p.y());
  const char* kind = path.closed ? "polygon" : "polyline";
  return fmt::format("<{}{} points=\"{}\"", kind, Look(style), points);
}

std::string Form(const Style& style, const Circle& circle) {
  return fmt::format("<circle{} cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"", Look(style), circle.centre.x(),
                     circle.centre.y(), circle.radius);
}

std::string Form(const Style&, const Text& text) {
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:.4g}\"{} fill=\"{}\" textLength=\"{:.1f}\" "
      "lengthAdjust=\"spacingAndGlyphs\">{}</text",
      text.at.x(), text.at.y(), text.font.size, text.font.bold ? " font-weight=\"bold\"" : "",
      ColourText(text.colour), text.extent.width, EscapeMarkup(text.text));
}

/// One window for all shapes that are clipped alike.
class Clips {
 public:
  /// The attribute that clips at `box`.
  std::string Attribute(const Box& box) {
    std::string text = fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>",
                                   box.x, box.y, box.width, box.height);
    std::size_t i = 0;
    while (i < windows_.size() && windows_[i] != text) ++i;
    if (i == windows_.size()) windows_.push_back(std::move(text));
    return fmt::format(" clip-path=\"url(#window{})\"", i);
  }
  std::string Definitions() const {
    std::string text;
    for (std::size_t i = 0; i < windows_.size(); ++i)
      text += fmt::format("<clipPath id=\"window{}\">{}</clipPath>\n", i, windows_[i]);
    return text.empty() ? text : "<defs>\n" + text + "</defs>\n";
  }

 private:
  std::vector<std::string> windows_;
};

std::string Element(const Shape& shape, Clips& clips) {
  std::string text = std::visit([&](const auto& form) { return Form(shape.style, form); }, shape.form);
  const bool is_text = std::holds_alternative<Text>(shape.form);
  if (is_text || !shape.clip) return text + (is_text ? ">\n" : "/>\n");
  return text + clips.Attribute(*shape.clip) + "/>\n";
}

}  // namespace

std::string ToSvg(const Drawing& drawing) {
  Clips clips;
  std::string body;
  const Layer* open = nullptr;
  for (const Shape& shape : drawing.shapes()) {
    if (shape.layer != open) {
      body += fmt::format("{}<g class=\"{}\">\n", open ? "</g>\n" : "", shape.layer->id);
      open = shape.layer;
    }
    body += Element(shape, clips);
  }
  if (open) body += "</g>\n";
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.4g} {1:.5g}\" width=\"{0:.4g}\" "
             "height=\"{1:.5g}\" font-family=\"{2}, Verdana, sans-serif\" stroke-linejoin=\"round\">\n",
             drawing.width(), drawing.height(), kFontFamily) +
         clips.Definitions() +
         fmt::format("<rect width=\"100%\" height=\"100%\" fill=\"{}\"/>\n",
                     ColourText(drawing.background())) +
         body + "</svg>\n";
}

std::string EscapeMarkup(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return escaped;
}

}  // namespace priamos::drawing
