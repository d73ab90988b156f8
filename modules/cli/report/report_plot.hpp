#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace priamos::cli {

/// One line of a plot: x is time [s], y in the plot's unit.
struct PlotSeries {
  std::string name;
  std::string colour;  ///< a CSS colour
  std::vector<Eigen::Vector2d> points;
  bool dashed = false;
};

/// A stretch of time worth a shade.
struct PlotSpan {
  double begin_s = 0, end_s = 0;
  std::string label;
};

/// A diagram of values over time [s]; all series share `unit`.
struct Plot {
  std::string title;
  std::string unit;
  std::vector<PlotSeries> series;
  std::vector<PlotSpan> spans;
  double end_s = 0;  ///< end of the time axis, which begins at 0
};

/// An inline SVG figure that scales with its place, with axes, legend and shades; no external resource.
/// Points that are not numbers are left out.
std::string ToSvg(const Plot& plot);

}  // namespace priamos::cli
