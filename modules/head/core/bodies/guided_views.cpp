#include "head/core/bodies/guided_views.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "head/core/bodies/contour_pieces.hpp"

namespace priamos::head {
namespace {

constexpr double kShortest_px = 12;  ///< a shorter prediction is not measured
constexpr double kBeside_px = 2;     ///< lines of one direction so near to each other are of one edge
constexpr double kMostOfIt = 0.7;    ///< share of an edge that is enough to measure it
constexpr int kBeyond = 2;           ///< pieces beyond its ends in which an edge may run on
constexpr double kLeastBlur_px = 1;  ///< sharp edges are not lost
constexpr double kAligned = 0.98;    ///< cosine of the angle between them

/// True if the middle of `line` lies on `measured`, which has its direction.
bool Repeats(const EdgeSegment& measured, const EdgeSegment& line) {
  const Eigen::Vector2d middle = (line.begin + line.end) / 2 - measured.begin;
  const double along = measured.direction().dot(middle);
  return along > 0 && along < measured.length_px() && std::abs(measured.normal().dot(middle)) < kBeside_px &&
         measured.direction().dot(line.direction()) > kAligned;
}

void Append(const EdgeSegment& segment, const EdgeImage& from, EdgeImage& to) {
  EdgeSegment copy = segment;
  copy.first_point = static_cast<int>(to.points.size());
  const auto first = from.points.begin() + segment.first_point;
  to.points.insert(to.points.end(), first, first + segment.n_points);
  to.segments.push_back(copy);
}

void RemoveLast(EdgeImage& edges) {
  edges.points.resize(edges.segments.back().first_point);
  edges.segments.pop_back();
}

/// `meter`: nullptr, or what measures those of which `guide` loses most.
EdgeImage MeasureAlong(const LandmarkModel& seen, const Eigen::Isometry3d& base_from_model,
                       const CameraView& view, GuidedEdges& guide, const StepMeter* meter) {
  EdgeImage measured;
  const ContourPieces contour(seen, base_from_model, view);
  for (std::size_t i = 0; i < seen.edges.size(); ++i) {
    const auto& expected = contour.edges()[i];
    if (!expected || expected->length_px() < kShortest_px) continue;
    const bool is_guided =
        guide.Measure(view.camera->Distort(expected->p), view.camera->Distort(expected->q), measured);
    const double guided_px = is_guided ? measured.segments.back().length_px() : 0;
    if (!meter || guided_px > kMostOfIt * expected->length_px()) continue;
    EdgeImage line;
    if (!AppendLine(contour.Measure(*meter, i, kBeyond), expected->length_px(), view.blur_px, line) ||
        line.segments[0].length_px() < guided_px)
      continue;
    if (is_guided) RemoveLast(measured);
    Append(line.segments[0], line, measured);
  }
  return measured;
}

/// Takes over what `view` has of one of its lines.
void Append(const ViewLine& line, const CameraView& view, EdgeImage& edges, CameraView& to) {
  const EdgeSegment& segment = view.edges->segments[line.segment];
  const auto first = view.points.begin() + segment.first_point;
  to.points.insert(to.points.end(), first, first + segment.n_points);
  to.lines.push_back(line);
  to.lines.back().segment = static_cast<int>(edges.segments.size());
  to.table.px.push_back(static_cast<float>(line.p.x()));
  to.table.py.push_back(static_cast<float>(line.p.y()));
  to.table.qx.push_back(static_cast<float>(line.q.x()));
  to.table.qy.push_back(static_cast<float>(line.q.y()));
  to.table.length.push_back(static_cast<float>(line.length_px));
  Append(segment, *view.edges, edges);
}

/// `view` with what was measured, each edge once: as it was measured where it was, else as the operator found
/// it. `edges`: what was measured; the view refers to it, and what is taken over is added to it.
CameraView Join(const CameraView& view, EdgeImage& edges) {
  const std::vector<EdgeSegment> measured = edges.segments;
  edges.width = view.size.width;
  edges.height = view.size.height;
  edges.noise_sigma = view.edges->noise_sigma;
  edges.mean_grey = view.edges->mean_grey;
  edges.saturated_share = view.edges->saturated_share;
  CameraView joined = MakeView(*view.camera, edges);
  for (const ViewLine& line : view.lines) {
    const EdgeSegment& found = view.edges->segments[line.segment];
    const auto repeats = [&](const EdgeSegment& m) { return Repeats(m, found); };
    if (std::none_of(measured.begin(), measured.end(), repeats)) Append(line, view, edges, joined);
  }
  joined.blur_px = view.blur_px;
  return joined;
}

}  // namespace

GuidedViews::GuidedViews(const LandmarkModel& seen, const Eigen::Isometry3d& base_from_model,
                         std::span<const CameraView> views, std::span<GuidedEdges> guides,
                         std::span<const StepMeter> meters) {
  edges_.reserve(views.size());  // views_ refer to them
  views_.reserve(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    const StepMeter* meter = i < meters.size() && views[i].blur_px > kLeastBlur_px ? &meters[i] : nullptr;
    edges_.push_back(MeasureAlong(seen, base_from_model, views[i], guides[i], meter));
    views_.push_back(Join(views[i], edges_.back()));
  }
}

}  // namespace priamos::head
