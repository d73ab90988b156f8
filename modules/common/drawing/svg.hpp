#pragma once

#include <string>

#include "common/drawing/drawing.hpp"

namespace priamos::drawing {

/// The drawing as an SVG file that needs nothing from outside. Shapes of one layer that follow each other
/// are a group whose class is the layer's id. Text keeps its measured length also where a viewer sets it in
/// another typeface.
std::string ToSvg(const Drawing& drawing);

/// Text fit for the inside of HTML and SVG; control characters become blanks.
std::string EscapeMarkup(const std::string& text);

}  // namespace priamos::drawing
