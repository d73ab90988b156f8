#pragma once

#include <cairo.h>

#include <string>

#include "common/drawing/text_extent.hpp"

namespace priamos::drawing {

/// Shows one line of UTF-8 text whose base line begins at the current point of `to`. Set without hinting, so
/// that it measures the same at every scale.
void ShowText(cairo_t* to, const std::string& text, const Font& font);

}  // namespace priamos::drawing
