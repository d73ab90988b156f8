#include "head/see/see_drawing.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <map>

namespace priamos::head {
namespace {

using drawing::Colour, drawing::Layer, drawing::Symbol;

constexpr Layer kParallelogram{
    "parallelogram", "parallelogram", {.fill = Colour{0xdc78c8}, .opacity = 0.35}, Symbol::kArea};
constexpr Layer kUpright{"upright", "upright edge", {.line = Colour{0x3cc83c}, .width = 1.6}};
constexpr Layer kLevel{"level", "level edge", {.line = Colour{0x48a0f0}, .width = 1.6}};
constexpr Layer kOther{"sloping", "other edge", {.line = Colour{0xfa8c28}, .width = 1.6}};
constexpr Layer kCorner{"corner", "corner", {.line = Colour{0xff4040}, .width = 1.2}, Symbol::kDot};
constexpr Layer kUnmatched{"unmatched", "edge without a match", {.line = Colour{0x969696}, .width = 0.8}};
constexpr Layer kAlong{"epipolar", "matched, distance unknown", {.line = Colour{0xffffff}, .width = 1.6}};

/// Class of distances below `up_to_m` [m] that are not in the class before.
struct DistanceClass {
  double up_to_m;
  Layer layer;
};
constexpr std::array<DistanceClass, 6> kDistances{{
    {1, {"to-1m", "nearer than 1 m", {.line = Colour{0xff3030}, .width = 1.6}}},
    {1.5, {"to-1.5m", "1 to 1.5 m", {.line = Colour{0xffa020}, .width = 1.6}}},
    {2.5, {"to-2.5m", "1.5 to 2.5 m", {.line = Colour{0xf0f020}, .width = 1.6}}},
    {4, {"to-4m", "2.5 to 4 m", {.line = Colour{0x40e040}, .width = 1.6}}},
    {8, {"to-8m", "4 to 8 m", {.line = Colour{0x20d8f0}, .width = 1.6}}},
    {INFINITY, {"beyond-8m", "farther than 8 m", {.line = Colour{0x5080ff}, .width = 1.6}}},
}};

/// Layer of a segment by its direction in the image, so that a door is seen at a glance.
const Layer& LayerOf(const EdgeSegment& segment) {
  const Eigen::Vector2d d = segment.direction().cwiseAbs();
  constexpr double kNearlyAxis = 0.1;
  if (d.x() < kNearlyAxis) return kUpright;
  return d.y() < kNearlyAxis ? kLevel : kOther;
}

/// Depth [m] of the middle of a matched edge before a camera; infinite if it is not known.
double DepthOf(const StereoMatch& match, const CameraModel& camera) {
  if (!match.space) return INFINITY;
  return MetricDepth(camera, 0.5 * (match.space->from + match.space->to));
}

const Layer& LayerAt(double depth_m) {
  for (const DistanceClass& distance : kDistances)
    if (depth_m < distance.up_to_m) return distance.layer;
  return kAlong;
}

}  // namespace

SeePage DrawContours(const cv::Mat& grey, const EdgeImage& edges, const ContourGraph& contours) {
  SeePage page(std::span(&grey, 1));
  for (const Polygon& polygon : contours.polygons()) {
    if (!polygon.is_parallelogram) continue;
    const auto outline = contours.Outline(polygon);
    page.Area(kParallelogram, 0, {outline.begin(), outline.end()});
  }
  for (const EdgeSegment& s : edges.segments) page.Line(LayerOf(s), 0, s.begin, s.end);
  for (const Corner& corner : contours.corners()) page.Ring(kCorner, 0, corner.at, 3);
  page.Finish();
  return page;
}

SeePage DrawMatches(std::span<const cv::Mat> greys, std::span<const CameraView> views,
                    std::span<const StereoMatch> matches) {
  SeePage page(greys);
  for (std::size_t i = 0; i < greys.size(); ++i)
    for (const EdgeSegment& s : views[i].edges->segments) page.Line(kUnmatched, i, s.begin, s.end);
  const auto draw = [&](const Layer& layer, std::size_t view, int line) {
    const EdgeSegment& s = views[view].edges->segments[views[view].lines[line].segment];
    page.Line(layer, view, s.begin, s.end);
  };
  std::multimap<double, const StereoMatch*, std::greater<>> from_far;  // so that near ones lie on top
  for (const StereoMatch& match : matches) from_far.emplace(DepthOf(match, *views[0].camera), &match);
  for (const auto& [depth_m, match] : from_far) {
    const Layer& layer = LayerAt(depth_m);
    draw(layer, 0, match->left);
    for (const int line : match->right) draw(layer, 1, line);
    for (const int line : match->third) draw(layer, 2, line);
  }
  page.Finish();
  return page;
}

}  // namespace priamos::head
