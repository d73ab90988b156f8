#include "head/core/landmark/landmark_view.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "head/core/landmark/prediction.hpp"

namespace priamos::head {
namespace {

constexpr double kMinShare = 0.5;  ///< share of a line's length that must lie along the prediction

std::vector<PredictedEdge> Predicted(const LandmarkModel& model, const Pose2& base_from_landmark,
                                     const Eigen::Matrix3d& covariance, const CameraView& picture) {
  return PredictEdges(model, base_from_landmark, covariance, *picture.camera, picture.size);
}

/// The pieces of a match as one edge, along the longest of them.
ViewedEdge Join(const EdgeMatch& match, const CameraView& picture) {
  const auto longest = std::max_element(match.lines.begin(), match.lines.end(), [&](int a, int b) {
    return picture.lines[a].length_px < picture.lines[b].length_px;
  });
  const ViewLine& line = picture.lines[*longest];
  const Eigen::Vector2d direction = (line.q - line.p).normalized();
  ViewedEdge edge{ViewedEdge::kMatched, line.p, line.q};
  double first = 0, last = direction.dot(line.q - line.p);
  for (const int i : match.lines) {
    for (const Eigen::Vector2d& end : {picture.lines[i].p, picture.lines[i].q}) {
      const double at = direction.dot(end - line.p);
      if (at < first) {
        first = at;
        edge.p = end;
      }
      if (at > last) {
        last = at;
        edge.q = end;
      }
    }
  }
  return edge;
}

/// Whether a line lies in the strip about a predicted edge, beside its length.
bool MayBe(const PredictedEdge& edge, const ViewLine& line, double reach_px, double max_angle_rad) {
  const Eigen::Vector2d along = edge.direction(), normal = edge.normal(), direction = line.q - line.p;
  if (std::abs(normal.dot(direction)) > std::sin(max_angle_rad) * line.length_px + 1) return false;
  if (std::abs(normal.dot(line.p - edge.p)) > reach_px || std::abs(normal.dot(line.q - edge.p)) > reach_px)
    return false;
  double from = along.dot(line.p - edge.p), to = along.dot(line.q - edge.p);
  if (from > to) std::swap(from, to);
  const double within = std::min(to, edge.length_px() + reach_px) - std::max(from, -reach_px);
  return within > kMinShare * line.length_px;
}

bool MayBeAny(const std::vector<PredictedEdge>& edges, const ViewLine& line,
              const LandmarkViewOptions& options) {
  return std::any_of(edges.begin(), edges.end(), [&](const PredictedEdge& edge) {
    return MayBe(edge, line, options.search_sigmas * edge.search_px + options.beside_px,
                 options.max_angle_rad);
  });
}

std::vector<bool> Used(const LandmarkFix& fix, const CameraView& picture, int camera) {
  std::vector<bool> used(picture.lines.size());
  for (const EdgeMatch& match : fix.matches) {
    if (match.camera != camera) continue;
    for (const int line : match.lines) used[line] = true;
  }
  return used;
}

}  // namespace

int CameraToShow(const LandmarkFix& fix) {
  if (fix.verdict == Verdict::kFound) return 0;
  std::array<int, 2> matches{};
  for (const EdgeMatch& match : fix.matches)
    if (match.camera < 2) ++matches[match.camera];
  return matches[1] < matches[0] ? 1 : 0;
}

LandmarkView ViewLandmark(const LandmarkModel& model, const LandmarkPrediction& prediction,
                          const LandmarkFix& fix, const CameraView& picture, int camera,
                          const LandmarkViewOptions& options) {
  LandmarkView view;
  view.camera = camera;
  const Eigen::Matrix3d search = LandmarkFixOptions{}.SearchCovariance(prediction);
  const auto expected = Predicted(model, prediction.base_from_landmark, search, picture);
  for (const PredictedEdge& e : expected) view.edges.push_back({ViewedEdge::kPredicted, e.p, e.q});
  for (const EdgeMatch& match : fix.matches) {
    if (match.camera == camera && !match.lines.empty()) view.edges.push_back(Join(match, picture));
  }
  std::vector<PredictedEdge> fitted;
  if (!fix.matches.empty())
    fitted = Predicted(model, fix.base_from_landmark, Eigen::Matrix3d::Zero(), picture);
  std::vector<std::pair<double, int>> rejected;
  const std::vector<bool> used = Used(fix, picture, camera);
  for (std::size_t i = 0; i < picture.lines.size(); ++i) {
    const ViewLine& line = picture.lines[i];
    if (used[i] || !MayBeAny(expected, line, options)) continue;
    rejected.emplace_back(line.length_px * (MayBeAny(fitted, line, options) ? 2 : 1), static_cast<int>(i));
  }
  std::stable_sort(rejected.begin(), rejected.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  const auto n = std::min(rejected.size(), static_cast<std::size_t>(options.max_rejected));
  for (std::size_t i = 0; i < n; ++i) {
    const ViewLine& line = picture.lines[rejected[i].second];
    view.edges.push_back({ViewedEdge::kRejected, line.p, line.q});
  }
  view.n_left_out = static_cast<int>(rejected.size() - n);
  return view;
}

}  // namespace priamos::head
