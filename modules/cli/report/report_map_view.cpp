#include "cli/report/report_map_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/principal_axes.hpp"

namespace priamos::cli {

using drawing::Box;
using Eigen::Vector2d;

namespace {

/// Points nearer than this to the one before coincide with it in the figure.
constexpr double kFine_px = 0.7;
/// Labels look at lines in steps of so many pixels.
constexpr double kStep_px = 8;
constexpr double kPadding_px = 2;
constexpr drawing::Layer kLabels{"label", ""};
constexpr drawing::Layer kLeaders{"leader", "", {.line = drawing::Colour{0x7b8590}, .width = 1.2}};

Vector2d NearestIn(const Box& box, const Vector2d& to) {
  return {std::clamp(to.x(), box.x, box.right()), std::clamp(to.y(), box.y, box.bottom())};
}

}  // namespace

MapView::MapView(drawing::Drawing& page, const Box& window, const Vector2d& centre_m, double px_per_m)
    : page_(page), window_(window), centre_m_(centre_m), px_per_m_(px_per_m) {
  around_.page = window;
}

Vector2d MapView::ToPage(const Vector2d& in_map) const {
  const Vector2d d = (in_map - centre_m_) * px_per_m_;
  return window_.middle() + Vector2d(d.x(), -d.y());
}

void MapView::Line(const drawing::Layer& layer, const std::vector<Vector2d>& points) {
  drawing::Path path;
  for (const auto& point : points) {
    const Vector2d at = ToPage(point);
    const bool last = &point == &points.back();
    if (path.points.empty() || last || (at - path.points.back()).norm() > kFine_px) path.points.push_back(at);
  }
  if (path.points.size() < 2) return;
  if (!layer.meaning.empty()) KeepOff(path.points);
  page_.Add(layer, path, window_);
}

void MapView::KeepOff(const std::vector<Vector2d>& line) {
  double since = kStep_px;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vector2d delta = line[i] - line[i - 1];
    const double length = delta.norm();
    if (!(length < 1e5)) continue;
    for (double at = std::max(0.0, kStep_px - since); at < length; at += kStep_px) {
      const Vector2d point = line[i - 1] + delta * (at / length);
      if (window_.Holds(point)) around_.lines.push_back(point);
    }
    since = std::fmod(since + length, kStep_px);
  }
}

void MapView::Area(const drawing::Layer& layer, const std::vector<Vector2d>& corners, double opacity) {
  drawing::Path path{{}, true};
  for (const auto& corner : corners) path.points.push_back(ToPage(corner));
  if (path.points.size() < 3) return;
  drawing::Style style = layer.style;
  style.opacity = std::min(style.opacity, opacity);
  page_.Add(layer, style, path, window_);
  if (!layer.style.line || layer.meaning.empty()) return;
  path.points.push_back(path.points.front());
  KeepOff(path.points);
}

void MapView::Solid(const drawing::Layer& layer, const Rectangle& shape) {
  const auto corners = shape.Corners();
  Area(layer, {corners.begin(), corners.end()});
  // In pieces as long as it is thick: a slanting wall takes no more of the page than itself.
  const bool long_x = shape.half_m.x() >= shape.half_m.y();
  const double half_m = std::max(0.02, shape.half_m.minCoeff()), reach_m = shape.half_m.maxCoeff();
  for (double at_m = -reach_m + half_m; at_m <= reach_m; at_m += 2 * half_m) {
    const Vector2d middle = ToPage(shape.map_from_centre * Vector2d(long_x ? at_m : 0, long_x ? 0 : at_m));
    const Box piece = Box{middle.x(), middle.y(), 0, 0}.Grown(half_m * px_per_m_);
    if (window_.Overlaps(piece)) KeepClear(piece);
  }
}

void MapView::Arrow(const drawing::Layer& layer, const Vector2d& from, const Vector2d& to, double head_px) {
  drawing::AddArrow(page_, layer, layer.style, ToPage(from), ToPage(to), head_px, window_);
  KeepOff({ToPage(from), ToPage(to)});
}

void MapView::Dot(const drawing::Layer& layer, const Vector2d& at, double radius_px) {
  const Vector2d centre = ToPage(at);
  if (!window_.Holds(centre)) return;
  page_.Add(layer, drawing::Circle{centre, radius_px}, window_);
  KeepClear(Box{centre.x(), centre.y(), 0, 0}.Grown(radius_px));
}

void MapView::Cross(const drawing::Layer& layer, const Vector2d& at, double radius_px) {
  const Vector2d centre = ToPage(at);
  if (!window_.Holds(centre)) return;
  const Vector2d d(radius_px, radius_px), e(radius_px, -radius_px);
  page_.Line(layer, centre - d, centre + d);
  page_.Line(layer, centre - e, centre + e);
  KeepClear(Box{centre.x(), centre.y(), 0, 0}.Grown(radius_px));
}

void MapView::Label(const Vector2d& at, const std::string& text, const drawing::Font& font,
                    drawing::Colour colour, double distance_px, bool centred) {
  const Vector2d point = ToPage(at);
  if (!point.allFinite() || !window_.Holds(point)) return;
  texts_.push_back({text, font, colour, drawing::MeasureText(text, font)});
  const auto& extent = texts_.back().extent;
  wishes_.push_back({point, extent.width + 2 * kPadding_px, extent.height(), distance_px, centred});
}

void MapView::Name(const std::vector<Vector2d>& corners, const std::string& text, const drawing::Font& font,
                   drawing::Colour colour) {
  Vector2d middle(0, 0);
  double narrowest_m = std::numeric_limits<double>::infinity(), reach_m = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    middle += corners[i] / static_cast<double>(corners.size());
    narrowest_m = std::min(narrowest_m, (corners[i] - corners[(i + 1) % corners.size()]).norm());
  }
  for (const auto& corner : corners) reach_m = std::max(reach_m, (corner - middle).norm());
  const bool fits = drawing::MeasureText(text, font).width < 0.9 * narrowest_m * px_per_m_;
  Label(middle, text, font, colour, fits ? 0 : 0.8 * reach_m * px_per_m_, fits);
}

void MapView::Lead(const Vector2d& at, const Box& to, double near_px) {
  const Vector2d end = NearestIn(to, at);
  if ((end - at).norm() > near_px) page_.Line(kLeaders, at, end);
}

void MapView::SetLabels() {
  const auto places = drawing::PlaceLabels(wishes_, around_);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i]) continue;
    Lead(wishes_[i].at, *places[i], wishes_[i].distance + 0.8 * wishes_[i].height);
    page_.Write(kLabels, {places[i]->x + kPadding_px, places[i]->y + texts_[i].extent.ascent}, texts_[i].text,
                texts_[i].font, texts_[i].colour);
  }
  texts_.clear();
  wishes_.clear();
}

std::vector<Vector2d> EllipseOutline(const Vector2d& centre, const Eigen::Matrix2d& covariance,
                                     double sigmas) {
  const PrincipalAxes<2> ellipse = PrincipalAxesOf(covariance);
  const Eigen::Matrix2d axes = ellipse.axes * ellipse.values.cwiseMax(0).cwiseSqrt().asDiagonal() * sigmas;
  constexpr int kCorners = 48;
  std::vector<Vector2d> outline;
  for (int i = 0; i < kCorners; ++i) {
    const double turn = 2 * std::numbers::pi * i / kCorners;
    outline.push_back(centre + axes * Vector2d(std::cos(turn), std::sin(turn)));
  }
  return outline;
}

}  // namespace priamos::cli
