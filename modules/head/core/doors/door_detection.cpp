#include "head/core/doors/door_detection.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "head/core/doors/door_evidence.hpp"
#include "head/core/doors/door_fit.hpp"
#include "head/core/stereo/plan_line.hpp"

namespace priamos::head {
namespace {

constexpr double kMinSpanShare = 0.25;   ///< share of the lintel between two uprights that must be seen
constexpr double kSameHeight_m = 0.012;  ///< lintels whose heights differ by less are tried once
constexpr double kOnFloor_m =
    0.12;                         ///< an upright that ends lower stands on the floor: skirting hides the rest
constexpr double kCorner_px = 8;  ///< largest distance of the lintel's end from the upright's top
constexpr double kRefined = 10;   ///< log odds that a fit may add
constexpr double kMostChi2 = 40;  ///< largest chi squared that counts: what fits worse is an outlier
constexpr double kMostDifference = 4;  ///< largest difference of both cameras' log odds that counts
constexpr double kSameCorners =
    0.3;  ///< share of the width: candidates with corners nearer in an image are one door
constexpr double kSmallest_px = 16;  ///< least distance of the uprights in an image

std::vector<const ViewLine*> LevelLines(const CameraView& view) {
  std::vector<const ViewLine*> level;
  for (const ViewLine& line : view.lines)
    if (IsLevel(line)) level.push_back(&line);
  return level;
}

class Detector {
 public:
  Detector(const CameraView& left, const CameraView& right, const DoorDetectionOptions& options)
      : views_{&left, &right}, options_(options), level_{LevelLines(left), LevelLines(right)} {}

  std::vector<DetectedDoor> Run() {
    std::vector<VerticalEdge> uprights = MatchVerticals(*views_[0], *views_[1], options_.stereo);
    std::erase_if(uprights,
                  [&](const VerticalEdge& v) { return v.z_max_m - v.z_min_m < options_.min_upright_m; });
    for (std::size_t i = 0; i < uprights.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) ConsiderPair(uprights[i], uprights[j]);
    for (const VerticalEdge& upright : uprights) ConsiderOneEyed(upright);
    return Best();
  }

 private:
  struct Candidate {
    DetectedDoor door;
    std::array<std::array<Eigen::Vector2d, 2>, 2> corners;  ///< camera, left and right; image
    std::array<int, 2> lintel;                              ///< lines
  };

  /// Heights of level lines over both uprights, in either image.
  std::vector<double> Lintels(const VerticalEdge& a, const VerticalEdge& b) const {
    std::vector<double> heights;
    for (int c = 0; c < 2; ++c) {
      for (const ViewLine* line : level_[c]) {
        const double za = HeightOn(*line, a.at), zb = HeightOn(*line, b.at), z = (za + zb) / 2;
        if (!IsDoorHigh(z)) continue;
        if (std::abs(za - zb) > 4 * options_.level_sigma_m || !Spans(*views_[c], *line, a, b, z)) continue;
        const bool known = std::any_of(heights.begin(), heights.end(),
                                       [&](double h) { return std::abs(h - z) < kSameHeight_m; });
        if (!known) heights.push_back(z);
      }
    }
    return heights;
  }

  bool IsDoorHigh(double z) const { return z > options_.min_height_m && z < options_.max_height_m; }

  bool Spans(const CameraView& view, const ViewLine& line, const VerticalEdge& a, const VerticalEdge& b,
             double z) const {
    const Eigen::Vector2d p = view.camera->Project({a.at.x(), a.at.y(), z}),
                          q = view.camera->Project({b.at.x(), b.at.y(), z});
    const double span = (q - p).norm();
    if (span < kSmallest_px) return false;
    const Eigen::Vector2d direction = (q - p) / span;
    const double s = direction.dot(line.p - p), t = direction.dot(line.q - p);
    return std::min(std::max(s, t), span) - std::max(std::min(s, t), 0.0) > kMinSpanShare * span;
  }

  void ConsiderPair(const VerticalEdge& a, const VerticalEdge& b) {
    if (a.left == b.left || a.right == b.right || !IsDoorWide(a.at, b.at)) return;
    for (const double height : Lintels(a, b)) Weigh(a, b, height);
  }

  bool IsDoorWide(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
    const double width = (a - b).norm();
    return width > options_.min_width_m && width < options_.max_width_m;
  }

  /// The other upright may be seen by one camera only: the lintel, which is level, leads to it.
  void ConsiderOneEyed(const VerticalEdge& a) {
    for (int c = 0; c < 2; ++c) {
      for (const ViewLine* lintel : level_[c]) {
        const double z = HeightOn(*lintel, a.at);
        if (!IsDoorHigh(z)) continue;
        const Eigen::Vector2d corner = views_[c]->camera->Project({a.at.x(), a.at.y(), z});
        const double p = (lintel->p - corner).norm(), q = (lintel->q - corner).norm();
        if (std::min(p, q) > kCorner_px) continue;
        FollowLintel(a, c, *lintel, z, p > q ? lintel->p : lintel->q);
      }
    }
  }

  void FollowLintel(const VerticalEdge& a, int c, const ViewLine& lintel, double z,
                    const Eigen::Vector2d& end) {
    for (int other = 0; other < 2; ++other) {
      for (const ViewLine& line : views_[other]->lines) {
        if (IsLevel(line)) continue;
        const auto at = Crossing(PlanLine(lintel, z), PlanLine(line, z));
        if (!at || at->x() < 0 || !IsDoorWide(a.at, *at)) continue;
        if ((views_[c]->camera->Project({at->x(), at->y(), z}) - end).norm() > kCorner_px) continue;
        VerticalEdge b = a;  // as uncertain as the upright that the lintel begins at, and more
        b.at = *at;
        b.covariance *= 2;
        Weigh(a, b, z);
      }
    }
  }

  double Prior(double width, double height) const {
    const double w = (width - options_.usual_width_m) / options_.width_sigma_m,
                 h = (height - options_.usual_height_m) / options_.height_sigma_m;
    return -0.5 * (w * w + h * h);
  }

  void Weigh(const VerticalEdge& a, const VerticalEdge& b, double height) {
    // Left is what a robot at the origin has on its left hand.
    const bool a_is_left = a.at.x() * b.at.y() - a.at.y() * b.at.x() < 0;
    const DoorShape proposal{a_is_left ? a.at : b.at, a_is_left ? b.at : a.at, height};
    const auto proposed = EvidenceFor(proposal);
    if (proposed[0].log_odds + proposed[1].log_odds < options_.min_log_odds - kRefined) return;
    const auto fit = FitDoor(views_, LinesOf(proposed), proposal, options_.edge_sigma_px);
    if (!fit || !IsDoorWide(fit->shape.left, fit->shape.right) || !IsDoorHigh(fit->shape.height_m)) return;
    const auto evidence = EvidenceFor(fit->shape);
    if (std::min(evidence[0].lintel.share, evidence[1].lintel.share) < kMinSpanShare) return;
    DetectedDoor door = AsDoor(*fit);
    door.log_odds =
        Together(evidence) + Prior(door.width_m, door.height_m) - 0.5 * std::min(fit->chi2, kMostChi2);
    for (int i = 0; i < 2; ++i)
      door.on_floor |= evidence[0].foot_inside[i] && evidence[0].hangs_m[i] < kOnFloor_m;
    if (door.log_odds > options_.min_log_odds)
      candidates_.push_back(AsCandidate(door, fit->shape, LinesOf(evidence)));
  }

  /// Log odds of both images. If only one camera sees the door, it is elsewhere: the weaker evidence counts
  /// twice.
  static double Together(const std::array<DoorEvidence, 2>& evidence) {
    const auto [least, most] = std::minmax(evidence[0].log_odds, evidence[1].log_odds);
    return 2 * least + std::min(most - least, kMostDifference);
  }

  std::array<DoorEvidence, 2> EvidenceFor(const DoorShape& shape) const {
    return {WeighDoor(*views_[0], shape), WeighDoor(*views_[1], shape)};
  }

  static DoorLines LinesOf(const std::array<DoorEvidence, 2>& evidence) {
    DoorLines lines;
    for (int c = 0; c < 2; ++c) {
      lines.lintel[c] = evidence[c].lintel.line;
      for (int i = 0; i < 2; ++i) lines.uprights[c][i] = evidence[c].uprights[i].line;
    }
    return lines;
  }

  DetectedDoor AsDoor(const DoorFit& fit) const {
    DetectedDoor door;
    const Eigen::Vector2d middle = (fit.shape.left + fit.shape.right) / 2,
                          across = fit.shape.left - fit.shape.right;
    // From the right upright to the left one is the door's y axis.
    door.base_from_door = {middle.x(), middle.y(), WrapAngle(std::atan2(across.y(), across.x()) - kPi / 2)};
    Eigen::Matrix<double, 2, 5> half = Eigen::Matrix<double, 2, 5>::Zero();
    half.leftCols<2>() = half.middleCols<2>(2) = Eigen::Matrix2d::Identity() / 2;
    door.covariance = half * fit.covariance * half.transpose() +
                      options_.frame_sigma_m * options_.frame_sigma_m * Eigen::Matrix2d::Identity();
    door.width_m = across.norm();
    door.height_m = fit.shape.height_m;
    return door;
  }

  Candidate AsCandidate(const DetectedDoor& door, const DoorShape& shape, const DoorLines& lines) const {
    Candidate c{door, {}, lines.lintel};
    for (int i = 0; i < 2; ++i)
      c.corners[i] = {views_[i]->camera->Project({shape.left.x(), shape.left.y(), shape.height_m}),
                      views_[i]->camera->Project({shape.right.x(), shape.right.y(), shape.height_m})};
    return c;
  }

  /// Whether two candidates are one door. The same edges cannot be two doors; mostly one is behind the other
  /// and made of edges that do not belong together.
  bool IsSame(const Candidate& a, const Candidate& b) const {
    const Eigen::Vector2d away = a.door.base_from_door.translation() - b.door.base_from_door.translation();
    if (away.norm() < options_.same_door_m) return true;
    for (int c = 0; c < 2; ++c) {
      if (a.lintel[c] == b.lintel[c]) return true;
      const double width = (a.corners[c][0] - a.corners[c][1]).norm();
      const double apart =
          (a.corners[c][0] - b.corners[c][0]).norm() + (a.corners[c][1] - b.corners[c][1]).norm();
      if (apart < 2 * kSameCorners * width) return true;
    }
    return false;
  }

  std::vector<DetectedDoor> Best() {
    std::stable_sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
      return a.door.log_odds > b.door.log_odds;
    });
    std::vector<const Candidate*> best;
    for (const Candidate& c : candidates_)
      if (std::none_of(best.begin(), best.end(), [&](const Candidate* d) { return IsSame(*d, c); }))
        best.push_back(&c);
    std::vector<DetectedDoor> doors;
    doors.reserve(best.size());
    for (const Candidate* c : best) doors.push_back(c->door);
    return doors;
  }

  std::array<const CameraView*, 2> views_;
  const DoorDetectionOptions& options_;
  std::array<std::vector<const ViewLine*>, 2> level_;
  std::vector<Candidate> candidates_;
};

}  // namespace

std::vector<DetectedDoor> DetectDoors(const CameraView& left, const CameraView& right,
                                      const DoorDetectionOptions& options) {
  return Detector(left, right, options).Run();
}

}  // namespace priamos::head
