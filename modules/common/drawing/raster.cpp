#include "common/drawing/raster.hpp"

#include <cairo.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "common/drawing/pango_text.hpp"

namespace priamos::drawing {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

/// A surface on the raster's own pixels.
Surface SurfaceOn(Raster& raster) {
  Surface surface(
      cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(raster.pixels.data()),
                                          CAIRO_FORMAT_RGB24, raster.width, raster.height, raster.width * 4),
      cairo_surface_destroy);
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(std::string("drawing: ") +
                             cairo_status_to_string(cairo_surface_status(surface.get())));
  return surface;
}

void SetColour(cairo_t* to, Colour colour, double opacity = 1) {
  const auto part = [&](int shift) { return (colour.rgb >> shift & 0xff) / 255.0; };
  cairo_set_source_rgba(to, part(16), part(8), part(0), opacity);
}

/// Fills and lines the current path.
void Apply(cairo_t* to, const Style& style) {
  if (style.fill) {
    SetColour(to, *style.fill, style.opacity);
    cairo_fill_preserve(to);
  }
  if (style.line) {
    SetColour(to, *style.line);
    cairo_set_line_width(to, style.width);
    cairo_set_line_join(to, CAIRO_LINE_JOIN_ROUND);
    cairo_set_dash(to, &style.dash, style.dash > 0 ? 1 : 0, 0);
    cairo_stroke_preserve(to);
  }
  cairo_new_path(to);
}

void PaintForm(cairo_t* to, const Style& style, const Path& path) {
  for (const auto& point : path.points) cairo_line_to(to, point.x(), point.y());
  if (path.closed) cairo_close_path(to);
  Apply(to, style);
}

void PaintForm(cairo_t* to, const Style& style, const Circle& circle) {
  cairo_arc(to, circle.centre.x(), circle.centre.y(), circle.radius, 0, 2 * std::numbers::pi);
  Apply(to, style);
}

void PaintForm(cairo_t* to, const Style&, const Text& text) {
  SetColour(to, text.colour);
  cairo_move_to(to, text.at.x(), text.at.y());
  ShowText(to, text.text, text.font);
}

cairo_status_t Append(void* into, const unsigned char* bytes, unsigned n) {
  static_cast<std::string*>(into)->append(reinterpret_cast<const char*>(bytes), n);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

Raster::Raster(int width_px, int height_px, Colour background)
    : width(width_px),
      height(height_px),
      pixels(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px), background.rgb) {}

void Paint(const Drawing& drawing, double scale, Raster& raster) {
  const Surface surface = SurfaceOn(raster);
  const Context to(cairo_create(surface.get()), cairo_destroy);
  cairo_scale(to.get(), scale, scale);
  for (const Shape& shape : drawing.shapes()) {
    cairo_save(to.get());
    if (shape.clip) {
      cairo_rectangle(to.get(), shape.clip->x, shape.clip->y, shape.clip->width, shape.clip->height);
      cairo_clip(to.get());
    }
    std::visit([&](const auto& form) { PaintForm(to.get(), shape.style, form); }, shape.form);
    cairo_restore(to.get());
  }
  cairo_surface_flush(surface.get());
}

Raster Paint(const Drawing& drawing, double scale) {
  Raster raster(static_cast<int>(std::ceil(drawing.width() * scale)),
                static_cast<int>(std::ceil(drawing.height() * scale)), drawing.background());
  Paint(drawing, scale, raster);
  return raster;
}

std::string ToPng(const Raster& raster) {
  Raster copy = raster;
  const Surface surface = SurfaceOn(copy);
  std::string bytes;
  const auto status = cairo_surface_write_to_png_stream(surface.get(), Append, &bytes);
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(std::string("PNG: ") + cairo_status_to_string(status));
  return bytes;
}

}  // namespace priamos::drawing
