#include "cli/report/report_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/drawing/svg.hpp"

namespace priamos::cli {
namespace {

constexpr double kPlotWidth = 400, kPlotHeight = 230, kLeft = 46, kRight = 12, kTop = 52, kBottom = 28;
/// Base line of the legend, below the title: together they would not fit a telephone.
constexpr double kLegend = 40;
/// More points than this in one line cannot be distinguished in the figure.
constexpr std::size_t kMostPoints = 700;

/// 1, 2 or 5 times a power of ten, so that an axis of `span` gets about `wanted` steps.
double NiceStep(double span, double wanted) {
  const double raw = std::max(span, 1e-9) / wanted;
  const double power = std::pow(10, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (raw <= factor * power) return factor * power;
  return 10 * power;
}

class Axes {
 public:
  explicit Axes(const Plot& plot) : end_s_(std::max(plot.end_s, 1e-3)) {
    for (const PlotSeries& series : plot.series)
      for (const auto& point : series.points)
        if (point.allFinite()) Include(point.y());
    if (high_ - low_ < 1e-9) high_ = low_ + 1;
    step_ = NiceStep(high_ - low_, 4);
    low_ = std::floor(low_ / step_) * step_;
    high_ = std::ceil(high_ / step_) * step_;
  }

  double X(double t_s) const { return kLeft + t_s / end_s_ * (kPlotWidth - kLeft - kRight); }
  double Y(double y) const {
    return kPlotHeight - kBottom - (y - low_) / (high_ - low_) * (kPlotHeight - kTop - kBottom);
  }

  std::string Grid() const {
    std::string svg;
    for (int i = 0; low_ + i * step_ <= high_ + step_ / 2; ++i) {
      const double y = low_ + i * step_;
      svg += fmt::format("<line class=\"grid\" x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>",
                         kLeft, kPlotWidth - kRight, Y(y), Y(y));
      svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{:.6g}</text>", kLeft - 6,
                         Y(y) + 4, std::abs(y) < step_ / 2 ? 0 : y);
    }
    const double step_s = NiceStep(end_s_, 6);
    for (int i = 0; i * step_s <= end_s_; ++i)
      svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{:.6g}{}</text>",
                         X(i * step_s), kPlotHeight - 8, i * step_s, i == 0 ? " s" : "");
    return svg;
  }

 private:
  void Include(double y) {
    low_ = std::min(low_, y);
    high_ = std::max(high_, y);
  }

  double end_s_, low_ = 0, high_ = 0, step_ = 1;
};

std::string Line(const PlotSeries& series, const Axes& axes) {
  const std::size_t stride = series.points.size() / kMostPoints + 1;
  std::string points;
  for (std::size_t i = 0; i < series.points.size(); i += stride)
    if (series.points[i].allFinite())
      points += fmt::format("{:.1f},{:.1f} ", axes.X(series.points[i].x()), axes.Y(series.points[i].y()));
  return fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"{} points=\"{}\"/>",
                     series.colour, series.dashed ? " stroke-dasharray=\"5 4\"" : "", points);
}

std::string Legend(const Plot& plot) {
  std::string svg;
  double x = kPlotWidth - kRight;
  for (auto series = plot.series.rbegin(); series != plot.series.rend(); ++series) {
    x -= 7.0 * static_cast<double>(series->name.size()) + 40;
    svg += fmt::format(
        "<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.0f}\" y2=\"{:.0f}\" stroke=\"{}\" stroke-width=\"2\"{}/>",
        x, x + 22, kLegend - 4, kLegend - 4, series->colour,
        series->dashed ? " stroke-dasharray=\"5 4\"" : "");
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.0f}\">{}</text>", x + 28, kLegend,
                       drawing::EscapeMarkup(series->name));
  }
  return svg;
}

}  // namespace

std::string ToSvg(const Plot& plot) {
  const Axes axes(plot);
  std::string svg = fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\"><title>{}</title>", kPlotWidth,
                                kPlotHeight, drawing::EscapeMarkup(plot.title));
  svg += fmt::format("<text class=\"title\" x=\"0\" y=\"18\">{} [{}]</text>",
                     drawing::EscapeMarkup(plot.title), drawing::EscapeMarkup(plot.unit));
  svg += axes.Grid() + Legend(plot);
  for (const PlotSpan& span : plot.spans) {
    svg += fmt::format("<rect class=\"span\" x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"{}\"/>",
                       axes.X(span.begin_s), kTop, axes.X(span.end_s) - axes.X(span.begin_s),
                       kPlotHeight - kTop - kBottom);
    svg += fmt::format("<text class=\"span\" x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
                       axes.X((span.begin_s + span.end_s) / 2), kTop + 12, drawing::EscapeMarkup(span.label));
  }
  for (const PlotSeries& series : plot.series) svg += Line(series, axes);
  return svg + "</svg>";
}

}  // namespace priamos::cli
