#include "head/core/calibration/correspondence.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace priamos::head {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLoose = 0.3;         // first tolerance, as a share of the spacing of the discs
constexpr double kRollStep = 0.17;     // about 10 degrees
constexpr std::size_t kFinalists = 8;  // hypotheses of one anchor that are fitted
constexpr double kSizeLoose = 1.35;    // ratio of predicted and measured radius at first
constexpr double kSizeStrict = 1.10;   // and at last, beside kSizeSlack_px
constexpr double kSizeSlack_px = 0.45;
constexpr std::size_t kFewestLabels = 7;

/// Which detection is nearest to a place: the candidate of a 16-pixel cell.
class NearestMap {
 public:
  explicit NearestMap(const std::vector<DetectedDisc>& discs) {
    for (const DetectedDisc& d : discs) {
      low_ = low_.cwiseMin(d.ellipse.centre_px);
      high_ = high_.cwiseMax(d.ellipse.centre_px);
    }
    columns_ = Cell(high_.x() - low_.x()) + 1;
    rows_ = Cell(high_.y() - low_.y()) + 1;
    nearest_.resize(static_cast<std::size_t>(columns_) * rows_);
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) Fill(discs, column, row);
    }
  }
  /// -1 far from all detections.
  int operator()(const Vector2d& px) const {
    const Vector2d d = px - low_;
    if (!(d.x() > -kMargin && d.y() > -kMargin)) return -1;
    if (!(d.x() < columns_ * kCell + kMargin && d.y() < rows_ * kCell + kMargin)) return -1;
    const int column = std::clamp(Cell(d.x()), 0, columns_ - 1);
    const int row = std::clamp(Cell(d.y()), 0, rows_ - 1);
    return nearest_[static_cast<std::size_t>(row) * columns_ + column];
  }

 private:
  static constexpr double kCell = 16, kMargin = 48;
  static int Cell(double distance) { return static_cast<int>(distance / kCell); }

  void Fill(const std::vector<DetectedDisc>& discs, int column, int row) {
    const Vector2d centre = low_ + kCell * Vector2d(column + 0.5, row + 0.5);
    double best = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < discs.size(); ++i) {
      const double distance = (discs[i].ellipse.centre_px - centre).squaredNorm();
      if (distance >= best) continue;
      best = distance;
      nearest_[static_cast<std::size_t>(row) * columns_ + column] = static_cast<int>(i);
    }
  }

  Vector2d low_{1e9, 1e9}, high_{-1e9, -1e9};
  int columns_, rows_;
  std::vector<int> nearest_;
};

/// The viewing ray of a detection, its apparent angular radius, and the disc normals it may have.
struct Sighting {
  Vector3d ray;                   ///< unit
  double angular_radius;          ///< of the disc's major axis
  std::vector<Vector3d> normals;  ///< in the camera, towards it
};

Sighting Sight(const Ellipse& e, double focal_px, const Vector2d& centre_px) {
  const Vector3d direction = ((e.centre_px - centre_px) / focal_px).homogeneous();
  Sighting s;
  s.ray = direction.normalized();
  const Vector3d right = Vector3d(-s.ray.y(), s.ray.x(), 0).norm() > 1e-6
                             ? s.ray.cross(Vector3d::UnitY()).cross(s.ray).cross(s.ray)
                             : Vector3d(Vector3d::UnitX());
  const Vector3d e1 = (right - right.dot(s.ray) * s.ray).normalized(), e2 = s.ray.cross(e1);
  // From the image plane to the plane across the ray: removes the stretch towards the image border.
  Eigen::Matrix2d across;
  across << e1.head<2>().transpose(), e2.head<2>().transpose();
  across /= direction.norm() * focal_px;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(across * e.shape_px2 * across.transpose());
  s.angular_radius = std::sqrt(solver.eigenvalues()(1));
  const double ratio = std::sqrt(std::max(0.0, solver.eigenvalues()(0))) / s.angular_radius;
  const auto axis = [&](int i) -> Vector3d {
    return solver.eigenvectors()(0, i) * e1 + solver.eigenvectors()(1, i) * e2;
  };
  const auto tilted = [&](double tilt, const Vector3d& towards) -> Vector3d {
    return -std::cos(tilt) * s.ray + std::sin(tilt) * towards;
  };
  const double tilt = std::acos(std::min(1.0, ratio));
  if (tilt < Radians(22)) {
    // Too round to say in which direction it is tilted.
    s.normals = {tilted(0, axis(0)), tilted(Radians(15), axis(0)), tilted(-Radians(15), axis(0)),
                 tilted(Radians(15), axis(1)), tilted(-Radians(15), axis(1))};
  } else {
    s.normals = {tilted(tilt, axis(0)), tilted(-tilt, axis(0))};
  }
  return s;
}

/// Right-handed axes (normal, upward across the normal, third).
Matrix3d NormalAxes(const Vector3d& normal, const Vector3d& up) {
  Vector3d across = up - up.dot(normal) * normal;
  if (across.norm() < 0.1) across = normal.unitOrthogonal();
  across.normalize();
  return (Matrix3d() << normal, across, normal.cross(across)).finished();
}

struct Hypothesis {
  double score = 0;
  PinholeView view;
};

bool ByScore(const Hypothesis& a, const Hypothesis& b) {
  return a.score < b.score;
}

/// The radius of the circle that has the area of the disc's image; 0 if the disc cannot be seen.
double MeanRadius(const PinholeView& view, const ReferenceDisc& disc) {
  const std::optional<Ellipse> ellipse = ProjectDisc(view.Model().image_from_base, disc);
  if (!ellipse) return 0;
  // The lens scales areas by about (1 + k1 r^2) (1 + 3 k1 r^2).
  const double r2 = view.InCamera(disc.centre_m).hnormalized().squaredNorm();
  return std::sqrt(ellipse->Area() / kPi) * (1 + 2 * view.k1 * r2);
}

/// Whether the rough labels are a first guess at the same answer.
bool MostlyAgree(const std::vector<priamos::head::Label>& rough,
                 const std::vector<priamos::head::Label>& labels) {
  const auto agreeing = std::count_if(rough.begin(), rough.end(), [&](const auto& label) {
    return std::find(labels.begin(), labels.end(), label) != labels.end();
  });
  return agreeing * 2 > static_cast<std::ptrdiff_t>(rough.size());
}

bool SimilarSize(double a, double b, double ratio) {
  return a < b * ratio && b < a * ratio;
}

}  // namespace

/// One image being searched.
class DiscLabeller::Search {
 public:
  Search(const DiscLabeller& dut, const std::vector<DetectedDisc>& detections)
      : dut_(dut),
        options_(dut.options_),
        object_(dut.object_),
        detections_(detections),
        nearest_(detections) {
    for (const DetectedDisc& d : detections) {
      major_px_.push_back(d.ellipse.SemiMajor());
      mean_px_.push_back(std::sqrt(d.ellipse.Area() / kPi));
    }
  }

  Outcome<Labelling> Run();

 private:
  std::vector<int> Anchors() const;
  std::vector<double> FocalLengths() const;
  /// The best views in which `anchor` is one of the discs. `quick` is set when one of them was tried at once
  /// and found right.
  std::vector<Hypothesis> Hypotheses(int anchor, std::optional<Labelling>& quick) const;
  /// Adds the views in which the sighted disc is `disc`.
  void Predict(int disc, const Sighting& sighting, double focal_px, std::vector<Hypothesis>& found) const;
  /// How many discs lie near detections if `disc` is at `place` with these axes (normal, up, third).
  double Score(int disc, const Vector3d& place, const Matrix3d& axes, double focal_px) const;
  /// Detections that lie where the view shows discs, within `share` of the spacing but at least `least_px`.
  std::vector<priamos::head::Label> Match(const PinholeView& view, double share, double least_px,
                                          double size_ratio) const;
  /// The nearest detection of similar size within `miss`, which becomes its distance; -1 if none.
  int Nearest(const Vector2d& px, double radius_px, double size_ratio, double& miss) const;
  std::vector<PointPair> Pairs(const std::vector<priamos::head::Label>& labels,
                               const PinholeView* bias_of) const;
  std::optional<Labelling> Grow(PinholeView view) const;
  std::optional<Labelling> Verify(PinholeView view) const;
  bool Enough(std::size_t labels) const {
    return labels >= kFewestLabels && labels + options_.max_hidden >= object_.discs.size();
  }
  LensPrior Prior(bool whole_lens) const;
  std::string WhyNot() const;

  const DiscLabeller& dut_;
  const LabellerOptions& options_;
  const ReferenceObject& object_;
  const std::vector<DetectedDisc>& detections_;
  NearestMap nearest_;
  std::vector<double> major_px_, mean_px_;  ///< semi-axis, and radius of the circle of equal area
  mutable std::size_t most_labels_ = 0;
};

LensPrior DiscLabeller::Search::Prior(bool whole_lens) const {
  LensPrior prior;
  prior.focal_px = std::sqrt(options_.min_focal_px * options_.max_focal_px);
  prior.focal_log_sigma = std::log(options_.max_focal_px / options_.min_focal_px) / 2;
  prior.centre_px = options_.image_centre_px;
  if (whole_lens) {
    prior.centre_sigma_px = options_.centre_sigma_px;
    prior.k1_sigma = options_.k1_sigma;
  }
  return prior;
}

std::vector<int> DiscLabeller::Search::Anchors() const {
  // The object's discs resemble each other in size and brightness; other bright spots stand alone.
  std::vector<std::pair<int, int>> ranked;
  for (std::size_t i = 0; i < detections_.size(); ++i) {
    int alike = 0;
    for (std::size_t j = 0; j < detections_.size(); ++j) {
      alike += SimilarSize(major_px_[i], major_px_[j], 1.4) &&
               SimilarSize(detections_[i].amplitude, detections_[j].amplitude, 1.5);
    }
    ranked.emplace_back(-alike, static_cast<int>(i));
  }
  std::sort(ranked.begin(), ranked.end());
  std::vector<int> anchors;
  for (const auto& [alike, i] : ranked) anchors.push_back(i);
  return anchors;
}

double DiscLabeller::Search::Score(int disc, const Vector3d& place, const Matrix3d& axes,
                                   double focal_px) const {
  double score = 1;
  int looked_at = 0;
  for (const Neighbour& other : dut_.neighbours_[disc]) {
    const Vector3d in_camera = place + axes * other.offset_m;
    if (in_camera.z() < 0.1) return 0;
    const double px_per_m = focal_px / in_camera.z();
    const Vector2d px = options_.image_centre_px + px_per_m * in_camera.head<2>();
    const int found = nearest_(px);
    if (found >= 0) {
      const double tolerance = kLoose * other.spacing_m * px_per_m;
      const double miss = (detections_[found].ellipse.centre_px - px).squaredNorm() / (tolerance * tolerance);
      if (miss < 1 && SimilarSize(other.radius_m * px_per_m, major_px_[found], kSizeLoose)) score += 1 - miss;
    }
    ++looked_at;
    // Neighbours are predicted best: where most of them fail, the rest is chance.
    if (looked_at == 3 && score < 1.2) return 0;
    if (looked_at == 5 && score < 2) return 0;
    if (looked_at == 8 && score < 3) return 0;
  }
  return score;
}

void DiscLabeller::Search::Predict(int disc, const Sighting& sighting, double focal_px,
                                   std::vector<Hypothesis>& found) const {
  const ReferenceDisc& d = object_.discs[disc];
  const Vector3d place = d.radius_m / sighting.angular_radius * sighting.ray;
  for (const Vector3d& normal : sighting.normals) {
    const Matrix3d upright = NormalAxes(normal, -Vector3d::UnitY());
    for (const Vector2d& roll : dut_.rolls_) {
      Matrix3d axes = upright;
      axes.col(1) = roll.x() * upright.col(1) + roll.y() * upright.col(2);
      axes.col(2) = roll.x() * upright.col(2) - roll.y() * upright.col(1);
      const double score = Score(disc, place, axes, focal_px);
      if (score < 4) continue;
      PinholeView view;
      view.focal_px = focal_px;
      view.centre_px = options_.image_centre_px;
      view.camera_from_object = axes * NormalAxes(d.normal, Vector3d::UnitZ()).transpose();
      view.offset_m = place - view.camera_from_object * d.centre_m;
      found.push_back({score, view});
    }
  }
}

std::vector<double> DiscLabeller::Search::FocalLengths() const {
  const double span = options_.max_focal_px / options_.min_focal_px;
  const int steps = std::max(1, static_cast<int>(std::ceil(std::log(span) / std::log(1.5))));
  std::vector<double> focal_px;
  for (int i = 0; i < steps; ++i) {
    // From the middle outwards.
    const int k = steps / 2 + (i % 2 == 0 ? i / 2 : -(i + 1) / 2);
    focal_px.push_back(options_.min_focal_px * std::pow(span, (k + 0.5) / steps));
  }
  return focal_px;
}

std::vector<Hypothesis> DiscLabeller::Search::Hypotheses(int anchor, std::optional<Labelling>& quick) const {
  std::vector<Hypothesis> all, some;
  const double promising = 0.6 * (static_cast<double>(object_.discs.size()) - options_.max_hidden);
  for (const double focal_px : FocalLengths()) {
    const Sighting sighting = Sight(detections_[anchor].ellipse, focal_px, options_.image_centre_px);
    for (std::size_t disc = 0; disc < object_.discs.size(); ++disc) {
      some.clear();
      Predict(static_cast<int>(disc), sighting, focal_px, some);
      if (some.empty()) continue;
      const auto best = std::max_element(some.begin(), some.end(), ByScore);
      if (dut_.unique_ && best->score > promising) quick = Grow(best->view);
      if (quick) return {};
      all.insert(all.end(), some.begin(), some.end());
    }
  }
  const std::size_t keep = std::min(kFinalists, all.size());
  std::partial_sort(all.begin(), all.begin() + keep, all.end(),
                    [](const auto& a, const auto& b) { return ByScore(b, a); });
  all.resize(keep);
  return all;
}

std::vector<priamos::head::Label> DiscLabeller::Search::Match(const PinholeView& view, double share,
                                                              double least_px, double size_ratio) const {
  std::vector<priamos::head::Label> labels;
  std::vector<double> misses;
  for (std::size_t disc = 0; disc < object_.discs.size(); ++disc) {
    const ReferenceDisc& d = object_.discs[disc];
    const Vector3d in_camera = view.InCamera(d.centre_m);
    if (in_camera.z() < 0.1) continue;
    const double px_per_m = view.focal_px / in_camera.z();
    double miss = std::max(least_px, share * dut_.spacing_m_[disc] * px_per_m);
    const int found = Nearest(view.Project(d.centre_m), MeanRadius(view, d), size_ratio, miss);
    if (found < 0) continue;
    // One detection is one disc: the better prediction wins.
    const auto taken = std::find_if(labels.begin(), labels.end(),
                                    [&](const auto& label) { return label.detection == found; });
    if (taken == labels.end()) {
      labels.push_back({static_cast<int>(disc), found});
      misses.push_back(miss);
    } else if (miss < misses[taken - labels.begin()]) {
      misses[taken - labels.begin()] = miss;
      taken->disc = static_cast<int>(disc);
    }
  }
  std::sort(labels.begin(), labels.end(), [](const auto& a, const auto& b) { return a.disc < b.disc; });
  return labels;
}

int DiscLabeller::Search::Nearest(const Vector2d& px, double radius_px, double size_ratio,
                                  double& miss) const {
  int found = -1;
  for (std::size_t i = 0; i < detections_.size(); ++i) {
    const double distance = (detections_[i].ellipse.centre_px - px).norm();
    if (distance > miss) continue;
    const bool similar =
        SimilarSize(radius_px, mean_px_[i], size_ratio) || std::abs(radius_px - mean_px_[i]) <= kSizeSlack_px;
    if (!similar) continue;
    miss = distance;
    found = static_cast<int>(i);
  }
  return found;
}

std::vector<PointPair> DiscLabeller::Search::Pairs(const std::vector<priamos::head::Label>& labels,
                                                   const PinholeView* bias_of) const {
  std::vector<PointPair> pairs;
  for (const auto& [disc, detection] : labels) {
    PointPair pair{object_.discs[disc].centre_m, detections_[detection].ellipse.centre_px};
    if (bias_of) pair.image_px -= CentroidBias(bias_of->Model(), object_.discs[disc]);
    pairs.push_back(pair);
  }
  return pairs;
}

std::optional<Labelling> DiscLabeller::Search::Grow(PinholeView view) const {
  double share = kLoose;
  for (int round = 0; round < 4; ++round, share *= 0.6) {
    const auto labels = Match(view, share, 3, kSizeLoose);
    if (labels.size() < 5) return std::nullopt;
    const std::vector<PointPair> pairs = Pairs(labels, nullptr);
    // Wrong pairs are still among them: errors beyond a share of the tolerance lose weight.
    const double sigma_px = std::max(1.0, 0.25 * share * dut_.spacing_m_[labels[0].disc] * view.focal_px /
                                              view.InCamera(pairs[0].point_m).z());
    FitView(view, pairs, Prior(labels.size() >= 9), 3, sigma_px);
    if (!view.offset_m.allFinite() || view.focal_px < 0.5 * options_.min_focal_px ||
        view.focal_px > 2 * options_.max_focal_px) {
      return std::nullopt;
    }
  }
  return Verify(view);
}

std::optional<Labelling> DiscLabeller::Search::Verify(PinholeView view) const {
  Labelling result;
  // Discs beyond those fitted so far are extrapolated: they may be far off until they take part.
  for (const auto& [share, tolerance_px] : {std::pair(0.1, 2.5), std::pair(0.05, 2.0), std::pair(0.0, 1.2)}) {
    result.labels = Match(view, share, tolerance_px, kSizeStrict);
    most_labels_ = std::max(most_labels_, result.labels.size());
    if (!Enough(result.labels.size())) return std::nullopt;
    const PinholeView before = view;
    FitView(view, Pairs(result.labels, &before), Prior(true), 3, 0.3);
  }
  // Strict at last: what is beyond is another bright spot or a disc that is partly hidden.
  result.labels = Match(view, 0, 3 * options_.max_rms_px, kSizeStrict);
  const std::vector<PointPair> pairs = Pairs(result.labels, &view);
  std::vector<priamos::head::Label> kept;
  double squares = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double error = (view.Project(pairs[i].point_m) - pairs[i].image_px).norm();
    if (error > 2 * options_.max_rms_px) continue;
    kept.push_back(result.labels[i]);
    squares += error * error;
  }
  result.labels = kept;
  if (!Enough(kept.size())) return std::nullopt;
  result.view = view;
  result.rms_px = std::sqrt(squares / kept.size());
  return result.rms_px <= options_.max_rms_px ? std::optional(result) : std::nullopt;
}

std::string DiscLabeller::Search::WhyNot() const {
  const std::size_t needed = std::max<std::size_t>(
      kFewestLabels, object_.discs.size() - std::min<std::size_t>(object_.discs.size(), options_.max_hidden));
  if (detections_.size() < needed) {
    return fmt::format("only {} disc-like spots in the image, {} are needed", detections_.size(), needed);
  }
  if (most_labels_ > 0) {
    return fmt::format("the best arrangement explains {} discs, {} are needed", most_labels_, needed);
  }
  return fmt::format("no arrangement of the {} bright spots looks like the object", detections_.size());
}

Outcome<Labelling> DiscLabeller::Search::Run() {
  if (!Enough(detections_.size())) return Refusal{WhyNot()};
  for (const int anchor : Anchors()) {
    std::optional<Labelling> best;
    const std::vector<Hypothesis> hypotheses = Hypotheses(anchor, best);
    for (const Hypothesis& h : hypotheses) {
      if (best && MostlyAgree(Match(h.view, kLoose, 3, kSizeLoose), best->labels)) continue;
      const std::optional<Labelling> next = Grow(h.view);
      if (!next || (best && next->labels == best->labels)) continue;
      if (best && std::max(best->labels.size(), next->labels.size()) <
                      1.1 * std::min(best->labels.size(), next->labels.size())) {
        return Refusal{"two arrangements of the discs fit equally well: the object is ambiguous"};
      }
      if (!best || next->labels.size() > best->labels.size()) best = next;
    }
    if (best) return *best;
  }
  return Refusal{WhyNot()};
}

DiscLabeller::DiscLabeller(const ReferenceObject& object, const LabellerOptions& options)
    : object_(object), options_(options) {
  for (double roll = 0; roll <= options.max_roll_rad; roll += kRollStep) {
    rolls_.emplace_back(std::cos(roll), std::sin(roll));
    if (roll > 0) rolls_.emplace_back(std::cos(roll), -std::sin(roll));
  }
  for (const ReferenceDisc& disc : object.discs) {
    double spacing = std::numeric_limits<double>::max();
    for (const ReferenceDisc& other : object.discs) {
      const double distance = (other.centre_m - disc.centre_m).norm();
      if (distance > 0) spacing = std::min(spacing, distance);
    }
    spacing_m_.push_back(spacing);
  }
  for (const ReferenceDisc& disc : object.discs) neighbours_.push_back(NeighboursOf(disc));
  unique_ = IsUnique();
}

std::vector<DiscLabeller::Neighbour> DiscLabeller::NeighboursOf(const ReferenceDisc& disc) const {
  const Matrix3d axes = NormalAxes(disc.normal, Vector3d::UnitZ());
  std::vector<Neighbour> neighbours;
  for (std::size_t i = 0; i < object_.discs.size(); ++i) {
    const Vector3d offset = object_.discs[i].centre_m - disc.centre_m;
    if (offset.norm() == 0) continue;
    neighbours.push_back({axes.transpose() * offset, spacing_m_[i], object_.discs[i].radius_m});
  }
  std::sort(neighbours.begin(), neighbours.end(),
            [](const auto& a, const auto& b) { return a.offset_m.norm() < b.offset_m.norm(); });
  return neighbours;
}

bool DiscLabeller::IsUnique() const {
  Vector3d middle = Vector3d::Zero(), normal = Vector3d::Zero();
  for (const ReferenceDisc& disc : object_.discs) {
    middle += disc.centre_m / object_.discs.size();
    normal += disc.normal;
  }
  if (normal.norm() < 0.1) return false;
  double extent = 0;
  for (const ReferenceDisc& disc : object_.discs) extent = std::max(extent, (disc.centre_m - middle).norm());
  PinholeView front;
  front.focal_px = std::sqrt(options_.min_focal_px * options_.max_focal_px);
  front.centre_px = options_.image_centre_px;
  front.camera_from_object = NormalAxes(-Vector3d::UnitZ(), -Vector3d::UnitY()) *
                             NormalAxes(normal.normalized(), Vector3d::UnitZ()).transpose();
  front.offset_m = Vector3d(0, 0, 6 * extent) - front.camera_from_object * middle;
  std::vector<DetectedDisc> detections;
  for (const ReferenceDisc& disc : object_.discs) {
    const auto ellipse = ProjectDisc(front.Model().image_from_base, disc);
    if (!ellipse) continue;
    detections.emplace_back().ellipse = *ellipse;
    detections.back().amplitude = 100;
  }
  const Outcome<Labelling> found = Search(*this, detections).Run();
  return static_cast<bool>(found);
}

Outcome<Labelling> DiscLabeller::Label(const std::vector<DetectedDisc>& detections) const {
  if (detections.empty()) return Refusal{"no disc-like spots in the image"};
  return Search(*this, detections).Run();
}

}  // namespace priamos::head
