#pragma once

#include "common/drawing/drawing.hpp"

namespace priamos::drawing {

/// Layout of a legend.
struct LegendLook {
  Font font;
  Colour ink;
  double widen = 1;      ///< width of lines in the drawing over that of their layers
  double leading = 1.5;  ///< distance of two rows, in sizes of the font
};

/// Writes what every layer of the drawing means, beside a sample of it, into as many columns as fit between
/// x and x + width, from y downwards. Returns the height it took. So every layer of a drawing is in its
/// legend.
double WriteLegend(Drawing& drawing, double x, double y, double width, const LegendLook& look);

}  // namespace priamos::drawing
