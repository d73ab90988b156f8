#pragma once

#include <string>

namespace priamos::drawing {

/// The typeface of every drawing; Debian's fonts-dejavu-core.
inline constexpr const char* kFontFamily = "DejaVu Sans";

/// How text is set.
struct Font {
  double size = 12;  ///< height of a line without leading [px]
  bool bold = false;
};

/// What a line of text covers, from its origin on the base line [px].
struct TextExtent {
  double width = 0;    ///< to the right
  double ascent = 0;   ///< upwards, of the font, whatever the letters
  double descent = 0;  ///< downwards

  double height() const { return ascent + descent; }
};

/// Measures one line of UTF-8 text as it is drawn at any scale.
TextExtent MeasureText(const std::string& text, const Font& font);

}  // namespace priamos::drawing
