#include "head/core/bodies/contour_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "head/core/edges/median.hpp"

namespace priamos::head {
namespace {

constexpr double kPiece_px = 10;
constexpr double kExplained = 0.85;                  ///< share of the grey values that a step must explain
constexpr double kFaint = 4;                         ///< contrast of a step, in grey values and in sigmas
constexpr double kParallel = 0.8;                    ///< cosine between edges that may lie beside each other
constexpr double kApart_px = 1;                      ///< edges nearer to each other are one
constexpr double kOverlap_px = 3;                    ///< a neighbour counts so far beyond its ends
constexpr double kReach_px = 3, kReachByBlur = 2.5;  ///< steps farther off do not reach a piece

constexpr double kMostOf = 0.4;           ///< share of an edge that must be measured
constexpr std::size_t kFewestPieces = 3;  ///< that make a line
constexpr double kBeside_px = 1.2;        ///< pieces farther from the others are of something else
constexpr double kFloor_px = 0.1, kFloorByBlur = 0.1;  ///< least standard deviation of a piece

double MedianShift(const std::vector<const ContourPiece*>& pieces) {
  std::vector<double> shifts;
  shifts.reserve(pieces.size());
  for (const ContourPiece* piece : pieces) shifts.push_back(piece->step.shift_px);
  return Median(std::move(shifts));
}

/// The clear ones of the contrast sign that most have, near to their median.
std::vector<const ContourPiece*> Agreeing(std::span<const ContourPiece> pieces) {
  double rising = 0;
  for (const ContourPiece& piece : pieces)
    if (piece.IsStep()) rising += std::copysign(piece.length_px, piece.step.contrast);
  std::vector<const ContourPiece*> agreeing;
  agreeing.reserve(pieces.size());
  for (const ContourPiece& piece : pieces)
    if (piece.IsStep() && piece.step.contrast * rising > 0) agreeing.push_back(&piece);
  if (agreeing.empty()) return agreeing;
  const double median = MedianShift(agreeing);
  std::erase_if(agreeing, [&](const ContourPiece* piece) {
    return std::abs(piece->step.shift_px - median) > kBeside_px;
  });
  return agreeing;
}

/// Standard deviation of a step's place: what noise leaves, and what no profile tells.
double SigmaOf(const Step& step, double blur_px) {
  return std::hypot(kFloor_px + kFloorByBlur * blur_px,
                    (1 + blur_px) * step.contrast_sigma / std::abs(step.contrast));
}

}  // namespace

bool ContourPiece::IsStep() const {
  return step.explained > kExplained && std::abs(step.contrast) > kFaint * std::max(1.0, step.contrast_sigma);
}

ContourPieces::ContourPieces(const LandmarkModel& seen, const Eigen::Isometry3d& base_from_model,
                             const CameraView& view)
    : view_(view) {
  edges_.reserve(seen.edges.size());
  for (const LandmarkEdge& edge : seen.edges)
    edges_.push_back(
        ProjectEdge(*view.camera, view.size, base_from_model * edge.from, base_from_model * edge.to));
}

std::vector<ContourPiece> ContourPieces::Measure(const StepMeter& meter, std::size_t edge,
                                                 int n_beyond) const {
  const ProjectedEdge& projected = *edges_[edge];
  const double length = projected.length_px();
  const Eigen::Vector2d direction = projected.direction();
  const int n = std::max(1, static_cast<int>(length / kPiece_px));
  std::vector<ContourPiece> pieces;
  pieces.reserve(n + 2 * n_beyond);
  for (int k = -n_beyond; k < n + n_beyond; ++k) {
    ContourPiece piece;
    piece.along_px = (k + 0.5) * length / n;
    piece.length_px = length / n;
    const Eigen::Vector2d at = projected.p + piece.along_px * direction;
    const Eigen::Vector2d tangent =
        (view_.camera->Distort(at + direction) - view_.camera->Distort(at - direction)).normalized();
    piece.at = view_.camera->Distort(at);
    piece.normal = {-tangent.y(), tangent.x()};
    const auto step = meter.Measure(piece.at, piece.normal, piece.length_px, Beside(edge, piece.along_px));
    if (!step) continue;
    piece.step = *step;
    pieces.push_back(piece);
  }
  return pieces;
}

/// Where along the normal of an edge, `along_px` its length, others are: the nearest first.
std::vector<double> ContourPieces::Beside(std::size_t edge, double along_px) const {
  const Eigen::Vector2d direction = edges_[edge]->direction(), normal = edges_[edge]->normal();
  const double reach_px = kReach_px + kReachByBlur * view_.blur_px;
  std::vector<double> places;
  places.reserve(edges_.size());
  for (std::size_t j = 0; j < edges_.size(); ++j) {
    if (j == edge || !edges_[j]) continue;
    const Eigen::Vector2d other = edges_[j]->direction(), offset = edges_[j]->p - edges_[edge]->p;
    const double cosine = direction.dot(other);
    if (std::abs(cosine) < kParallel) continue;
    const double at = (along_px - direction.dot(offset)) / cosine;
    if (at < -kOverlap_px || at > edges_[j]->length_px() + kOverlap_px) continue;
    const double place = normal.dot(offset + at * other);
    if (std::abs(place) > kApart_px && std::abs(place) < reach_px) places.push_back(place);
  }
  std::sort(places.begin(), places.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  return places;
}

bool AppendLine(std::span<const ContourPiece> pieces, double length_px, double blur_px, EdgeImage& out) {
  const std::vector<const ContourPiece*> agreeing = Agreeing(pieces);
  double covered = 0, grey = 0, contrast = 0, variance = 0;
  for (const ContourPiece* piece : agreeing) {
    if (piece->along_px > 0 && piece->along_px < length_px) covered += piece->length_px;
    grey += piece->step.grey / static_cast<double>(agreeing.size());
    contrast += piece->step.contrast / static_cast<double>(agreeing.size());
  }
  if (agreeing.size() < kFewestPieces || covered < kMostOf * length_px) return false;
  EdgeSegment segment;
  segment.first_point = static_cast<int>(out.points.size());
  segment.n_points = static_cast<int>(agreeing.size());
  for (const ContourPiece* piece : agreeing) {
    const double sigma_px = SigmaOf(piece->step, blur_px);
    variance += sigma_px * sigma_px / static_cast<double>(agreeing.size());
    out.points.push_back({piece->at + piece->step.shift_px * piece->normal, sigma_px});
  }
  const Eigen::Vector2d first = out.points[segment.first_point].at, last = out.points.back().at;
  const Eigen::Vector2d half = agreeing[0]->length_px / 2 * (last - first).normalized();
  segment.begin = first - half;
  segment.end = last + half;
  if (contrast < 0) std::swap(segment.begin, segment.end);  // bright side on the right hand
  segment.centre = (segment.begin + segment.end) / 2;
  segment.sigma_normal_px = std::sqrt(variance / static_cast<double>(agreeing.size()));
  segment.sigma_angle_rad = std::sqrt(12.0) * segment.sigma_normal_px / segment.length_px();
  segment.grey_left = grey - std::abs(contrast) / 2;
  segment.grey_right = grey + std::abs(contrast) / 2;
  out.segments.push_back(segment);
  return true;
}

}  // namespace priamos::head
