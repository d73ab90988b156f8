#include "common/drawing/pango_text.hpp"

#include <pango/pangocairo.h>

#include <memory>

namespace priamos::drawing {
namespace {

template <class T>
using Object = std::unique_ptr<T, decltype(&g_object_unref)>;
using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

Object<PangoLayout> LayOut(cairo_t* to, const std::string& text, const Font& font) {
  Object<PangoLayout> layout(pango_cairo_create_layout(to), g_object_unref);
  const std::unique_ptr<cairo_font_options_t, decltype(&cairo_font_options_destroy)> options(
      cairo_font_options_create(), cairo_font_options_destroy);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  pango_cairo_context_set_font_options(pango_layout_get_context(layout.get()), options.get());
  pango_context_set_round_glyph_positions(pango_layout_get_context(layout.get()), FALSE);
  const std::unique_ptr<PangoFontDescription, decltype(&pango_font_description_free)> description(
      pango_font_description_new(), pango_font_description_free);
  pango_font_description_set_family(description.get(), kFontFamily);
  pango_font_description_set_weight(description.get(), font.bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
  pango_font_description_set_absolute_size(description.get(), font.size * PANGO_SCALE);
  pango_layout_set_font_description(layout.get(), description.get());
  pango_layout_set_single_paragraph_mode(layout.get(), TRUE);
  pango_layout_set_text(layout.get(), text.data(), static_cast<int>(text.size()));
  return layout;
}

}  // namespace

void ShowText(cairo_t* to, const std::string& text, const Font& font) {
  const auto layout = LayOut(to, text, font);
  cairo_rel_move_to(to, 0, -static_cast<double>(pango_layout_get_baseline(layout.get())) / PANGO_SCALE);
  pango_cairo_show_layout(to, layout.get());
  cairo_new_path(to);
}

TextExtent MeasureText(const std::string& text, const Font& font) {
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1), cairo_surface_destroy);
  const Context to(cairo_create(surface.get()), cairo_destroy);
  const auto layout = LayOut(to.get(), text, font);
  PangoRectangle logical;
  pango_layout_get_extents(layout.get(), nullptr, &logical);
  const double ascent = static_cast<double>(pango_layout_get_baseline(layout.get())) / PANGO_SCALE;
  return {static_cast<double>(logical.width) / PANGO_SCALE, ascent,
          static_cast<double>(logical.height) / PANGO_SCALE - ascent};
}

}  // namespace priamos::drawing
