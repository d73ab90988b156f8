#include "head/core/look/far_sight.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "common/square.hpp"
#include "head/core/camera/projection.hpp"

namespace priamos::head {
namespace {

using Row = Eigen::RowVector3d;

/// An image line that may be a known edge: what the base's heading would be off by, then.
struct Sighting {
  std::size_t edge = 0, view = 0;
  double turn_rad = 0;        ///< heading minus the expected one
  double sigma_rad = 0;       ///< of it, by this line and this edge alone
  Row by_base = Row::Zero();  ///< change of turn_rad by a motion of the base (x, y, yaw); the last is 1
  double width_rad = 0;       ///< it agrees with a heading within this
  double evidence = 0;        ///< of such an agreement, natural logarithm over chance
};

/// How the landmark in the base frame changes when the base moves (x, y, yaw).
Eigen::Matrix3d ByBase(const Pose2& base_from_landmark) {
  Eigen::Matrix3d by = -Eigen::Matrix3d::Identity();
  by(0, 2) = base_from_landmark.y;
  by(1, 2) = -base_from_landmark.x;
  return by;
}

/// Height at which the image row `v` sees the vertical through `at`.
double HeightAt(const CameraModel& camera, const Eigen::Vector2d& at, double v) {
  const Eigen::RowVector4d row = camera.image_from_base.row(1) - v * camera.image_from_base.row(2);
  return -(row.x() * at.x() + row.y() * at.y() + row.w()) / row.z();
}

/// Compares image lines with far edges.
class Search {
 public:
  Search(const FarEdges& far, const LandmarkPrediction& expected, std::span<const CameraView> views,
         const FarSightOptions& options)
      : far_(far), expected_(expected.base_from_landmark), views_(views), options_(options) {
    const Eigen::Matrix3d back = ByBase(expected_).inverse();
    base_covariance_ = back * expected.covariance * back.transpose();
    reach_rad_ = std::max(options.least_reach_rad, options.sigmas * std::sqrt(base_covariance_(2, 2)));
    for (std::size_t view = 0; view < views.size(); ++view)
      for (std::size_t edge = 0; edge < far.edges().size(); ++edge) Compare(edge, view);
  }

  LandmarkFix Run() const {
    LandmarkFix fix;
    fix.verdict = Verdict::kTooFewEdges;
    const Peak best = Best(std::nullopt);
    const std::vector<Sighting> inliers = Near(best.turn_rad);
    if (best.evidence < options_.min_evidence || EdgesOf(inliers) < options_.min_edges) return fix;
    if (Best(best.turn_rad).evidence > best.evidence - options_.min_lead) {
      fix.verdict = Verdict::kAmbiguous;
      return fix;
    }
    return Fused(inliers);
  }

 private:
  /// A heading, and how much better than chance lines agree with it.
  struct Peak {
    double turn_rad = 0, evidence = 0;
  };

  void Compare(std::size_t edge, std::size_t view) {
    const FarEdge& known = far_.edges()[edge];
    const Eigen::Vector2d at = expected_ * known.at;
    const CameraView& seen = views_[view];
    const Eigen::Vector3d middle(at.x(), at.y(), (known.bottom_m + known.top_m) / 2);
    if (!(seen.camera->Depth(middle) > 0)) return;
    const std::size_t first = sightings_.size();
    for (const ViewLine& line : seen.lines)
      if (const auto sighting = SightingOf(edge, view, line, at)) sightings_.push_back(*sighting);
    // By chance one of these lines lies within the width as often as there are lines in reach.
    const auto lines = static_cast<double>(sightings_.size() - first);
    for (std::size_t i = first; i < sightings_.size(); ++i) {
      Sighting& sighting = sightings_[i];
      sighting.width_rad = WidthOf(sighting);
      sighting.evidence = std::max(0.0, std::log(reach_rad_ / (lines * sighting.width_rad)));
    }
  }

  std::optional<Sighting> SightingOf(std::size_t edge, std::size_t view, const ViewLine& line,
                                     const Eigen::Vector2d& at) const {
    const FarEdge& known = far_.edges()[edge];
    const CameraView& seen = views_[view];
    const bool up = line.q.y() < line.p.y();
    if (up != known.bright_right || line.length_px < options_.min_length_px ||
        std::abs(line.plane.z()) > options_.lean_rad)
      return std::nullopt;
    const double p = HeightAt(*seen.camera, at, line.p.y()), q = HeightAt(*seen.camera, at, line.q.y());
    const double low = std::max(std::min(p, q), known.bottom_m), high = std::min(std::max(p, q), known.top_m);
    if (high - low < 0.3 * std::min(std::abs(p - q), known.top_m - known.bottom_m)) return std::nullopt;
    const Eigen::Vector3d point(at.x(), at.y(), (low + high) / 2);
    const Eigen::Vector2d across = line.plane.head<2>();
    // The plane's offset from the edge, and how it changes as the base moves.
    const double offset = line.plane.dot(point.homogeneous());
    const double by_yaw = across.dot(Eigen::Vector2d(at.y(), -at.x()));
    if (std::abs(by_yaw) < 0.1) return std::nullopt;
    Sighting sighting{.edge = edge, .view = view, .turn_rad = -offset / by_yaw};
    sighting.by_base = Row(-across.x(), -across.y(), by_yaw) / by_yaw;
    if (std::abs(sighting.turn_rad) > reach_rad_) return std::nullopt;
    sighting.sigma_rad = std::sqrt(VarianceOf(seen, line, point, known)) / std::abs(by_yaw);
    return sighting;
  }

  /// Of the offset of a plane of sight from an edge [m^2].
  double VarianceOf(const CameraView& seen, const ViewLine& line, const Eigen::Vector3d& point,
                    const FarEdge& known) const {
    const Eigen::Vector2d across = line.plane.head<2>().normalized();
    const double px_per_m = (line.normal.transpose() * ProjectionJacobian(*seen.camera, point) *
                             Eigen::Vector3d(across.x(), across.y(), 0))
                                .norm();
    const EdgeSegment& segment = seen.edges->segments[static_cast<std::size_t>(line.segment)];
    const Eigen::Vector2d in_landmark = expected_.rotation().transpose() * across;
    return Square(std::hypot(segment.sigma_normal_px, options_.camera_sigma_px) / px_per_m) +
           in_landmark.dot(known.covariance * in_landmark) + Square(options_.place_sigma_m);
  }

  /// Parallax that the uncertainty of the place explains differs between near edges and far ones.
  double WidthOf(const Sighting& sighting) const {
    const Row place(sighting.by_base.x(), sighting.by_base.y(), 0);
    const double by_place = place * base_covariance_ * place.transpose();
    return 2.5 * std::sqrt(Square(sighting.sigma_rad) + by_place / 4);
  }

  /// For each edge and view the line that agrees best with a heading, if one does.
  std::vector<Sighting> Near(double turn_rad) const {
    std::vector<Sighting> near;
    for (const Sighting& sighting : sightings_) {
      const double off = std::abs(sighting.turn_rad - turn_rad);
      if (off > sighting.width_rad) continue;
      const bool first =
          near.empty() || near.back().edge != sighting.edge || near.back().view != sighting.view;
      if (first)
        near.push_back(sighting);
      else if (off < std::abs(near.back().turn_rad - turn_rad))
        near.back() = sighting;
    }
    return near;
  }

  int EdgesOf(const std::vector<Sighting>& sightings) const {
    std::vector<bool> seen(far_.edges().size());
    for (const Sighting& sighting : sightings) seen[sighting.edge] = true;
    return static_cast<int>(std::ranges::count(seen, true));
  }

  static double EvidenceFor(const std::vector<Sighting>& near) {
    double evidence = 0;
    for (const Sighting& sighting : near) evidence += sighting.evidence;
    return evidence;
  }

  /// The heading with the most evidence, of those clearly different from `other`.
  Peak Best(std::optional<double> other) const {
    Peak best;
    for (const Sighting& candidate : sightings_) {
      if (other && std::abs(candidate.turn_rad - *other) < 2 * candidate.width_rad) continue;
      const double evidence = EvidenceFor(Near(candidate.turn_rad));
      if (evidence > best.evidence) best = {candidate.turn_rad, evidence};
    }
    return best;
  }

  /// The mean of the headings by their variances, as a fix.
  LandmarkFix Fused(const std::vector<Sighting>& sightings) const {
    double weights = 0, turn = 0, squares = 0, rows_px = 0;
    Row by_base = Row::Zero();
    for (const Sighting& s : sightings) {
      const double weight = 1 / Square(s.sigma_rad);
      weights += weight;
      turn += weight * s.turn_rad;
      by_base += weight * s.by_base;
      rows_px += PixelsPerRad(s.view);
    }
    turn /= weights;
    by_base /= weights;
    for (const Sighting& s : sightings) squares += Square((s.turn_rad - turn) / s.sigma_rad);
    const auto n = static_cast<double>(sightings.size());
    // Both images of an edge share the error of its place: they count as one.
    const double own =
        2 * std::max(1.0, squares / n) / weights + Square(options_.same_for_all_px * n / rows_px);
    return FixOf(turn, by_base, own, static_cast<int>(sightings.size()));
  }

  double PixelsPerRad(std::size_t view) const {
    const auto& m = views_[view].camera->image_from_base;
    return m.row(0).head<3>().cross(m.row(2).head<3>()).norm() / m.row(2).head<3>().squaredNorm();
  }

  LandmarkFix FixOf(double turn_rad, const Row& by_base, double own_variance, int n) const {
    constexpr double kLooser = 10, kLeast_m = 0.02;
    LandmarkFix fix;
    fix.verdict = Verdict::kFound;
    fix.n_matched = n;
    fix.base_from_landmark = Pose2{0, 0, -turn_rad} * expected_;
    // What such looks repeat is no more than what slip turns the base between two of them.
    const double variance = own_variance + far_.heading_variance();
    fix.own_share = 1;
    const double place_m =
        std::max(kLeast_m, kLooser * std::sqrt(base_covariance_.topLeftCorner<2, 2>().trace() / 2));
    Eigen::Matrix3d information = by_base.transpose() * by_base / variance;
    information.diagonal().head<2>().array() += 1 / Square(place_m);
    const Eigen::Matrix3d by = ByBase(fix.base_from_landmark);
    fix.covariance = by * information.inverse() * by.transpose();
    return fix;
  }

  const FarEdges& far_;
  Pose2 expected_;
  std::span<const CameraView> views_;
  FarSightOptions options_;
  Eigen::Matrix3d base_covariance_;
  double reach_rad_ = 0;
  std::vector<Sighting> sightings_;
};

}  // namespace

LandmarkFix SeeFar(const FarEdges& far, const LandmarkPrediction& expected, std::span<const CameraView> views,
                   const FarSightOptions& options) {
  return Search(far, expected, views, options).Run();
}

}  // namespace priamos::head
