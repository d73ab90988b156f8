#include "head/core/landmark/edge_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

namespace priamos::head {
namespace {

constexpr std::size_t kMarksAtOnce = sizeof(std::uint64_t);  ///< most lines are far from most edges

std::optional<EdgeCandidate> Compare(const PredictedEdge& edge, const Eigen::Vector2d& direction,
                                     const Eigen::Vector2d& normal, double length, const ViewLine& line,
                                     int index, double reach_px, double max_angle) {
  const double a = normal.dot(line.p - edge.p), b = normal.dot(line.q - edge.p);
  if (std::min(std::abs(a), std::abs(b)) > reach_px && a * b > 0) return std::nullopt;
  const double turn = std::abs(normal.dot(line.q - line.p));
  if (turn > max_angle * line.length_px + 1.0) return std::nullopt;  // one pixel is noise for a short line
  double s = direction.dot(line.p - edge.p), t = direction.dot(line.q - edge.p);
  const double slope = (b - a) / (t - s);
  if (s > t) std::swap(s, t);
  const double from = std::max(s, 0.0), to = std::min(t, length);
  if (to - from < 4) return std::nullopt;
  const double start = direction.dot(line.p - edge.p);
  const double distance = a + slope * ((from + to) / 2 - start);
  if (std::abs(distance) > reach_px) return std::nullopt;
  return EdgeCandidate{
      index, from, to, std::max(0.0, -s), std::max(0.0, t - length), distance, normal.dot(line.normal) > 0};
}

}  // namespace

/// Marks the lines that Compare may accept: all of them at once, with a little slack for single precision.
void CandidateSearch::MarkNear(const PredictedEdge& edge) {
  constexpr float kSlack = 0.01F;
  const LineTable& lines = view_.table;
  const Eigen::Vector2f n = edge.normal().cast<float>();
  const float offset = n.dot(edge.p.cast<float>()), reach = static_cast<float>(reach_px_) + kSlack;
  const float angle = static_cast<float>(max_angle_rad_), one = 1.0F + kSlack;
  marks_.assign((lines.px.size() + kMarksAtOnce - 1) / kMarksAtOnce * kMarksAtOnce, 0);
  for (std::size_t i = 0; i < lines.px.size(); ++i) {
    const float a = n.x() * lines.px[i] + n.y() * lines.py[i] - offset;
    const float b = n.x() * lines.qx[i] + n.y() * lines.qy[i] - offset;
    const bool turned = std::abs(b - a) > angle * lines.length[i] + one;
    const bool far = (a > reach && b > reach) || (a < -reach && b < -reach);
    marks_[i] = !(turned | far);
  }
}

void CandidateSearch::Find(const PredictedEdge& predicted, std::vector<EdgeCandidate>& found) {
  const double length = predicted.length_px();
  const Eigen::Vector2d direction = predicted.direction(), normal = predicted.normal();
  MarkNear(predicted);
  for (std::size_t begin = 0; begin < marks_.size(); begin += kMarksAtOnce) {
    std::uint64_t some = 0;
    std::memcpy(&some, &marks_[begin], kMarksAtOnce);
    if (!some) continue;
    for (std::size_t i = begin; i < begin + kMarksAtOnce; ++i) {
      if (!marks_[i]) continue;
      const auto c =
          Compare(predicted, direction, normal, length, view_.lines[i], int(i), reach_px_, max_angle_rad_);
      if (c) found.push_back(*c);
    }
  }
}

}  // namespace priamos::head
