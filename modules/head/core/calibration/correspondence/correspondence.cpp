#include "head/core/calibration/correspondence/correspondence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "head/core/calibration/correspondence/disc_sighting.hpp"
#include "head/core/calibration/correspondence/label_fit.hpp"
#include "head/core/calibration/correspondence/nearest_map.hpp"

namespace priamos::head {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRollStep = 0.17;     // about 10 degrees
constexpr std::size_t kFinalists = 8;  // hypotheses of one anchor that are fitted

struct Hypothesis {
  double score = 0;
  PinholeView view;
};

bool ByScore(const Hypothesis& a, const Hypothesis& b) {
  return a.score < b.score;
}

/// Whether the rough labels are a first guess at the same answer.
bool MostlyAgree(const std::vector<DiscLabel>& rough, const std::vector<DiscLabel>& labels) {
  const auto agreeing = std::count_if(rough.begin(), rough.end(), [&](const auto& label) {
    return std::find(labels.begin(), labels.end(), label) != labels.end();
  });
  return agreeing * 2 > static_cast<std::ptrdiff_t>(rough.size());
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
        nearest_(detections),
        fit_(object_, options_, dut.spacing_m_, detections) {
    for (const DetectedDisc& d : detections) major_px_.push_back(d.ellipse.SemiMajor());
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
  std::string WhyNot() const;

  const DiscLabeller& dut_;
  const LabellerOptions& options_;
  const ReferenceObject& object_;
  const std::vector<DetectedDisc>& detections_;
  NearestMap nearest_;
  LabelFit fit_;
  std::vector<double> major_px_;  ///< major semi-axis of every detection's ellipse
};

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
  anchors.reserve(ranked.size());
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
      const double tolerance = LabelFit::kLoose * other.spacing_m * px_per_m;
      const double miss = (detections_[found].ellipse.centre_px - px).squaredNorm() / (tolerance * tolerance);
      if (miss < 1 && SimilarSize(other.radius_m * px_per_m, major_px_[found], LabelFit::kSizeLoose))
        score += 1 - miss;
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
    const Sighting sighting = SightDisc(detections_[anchor].ellipse, focal_px, options_.image_centre_px);
    for (std::size_t disc = 0; disc < object_.discs.size(); ++disc) {
      some.clear();
      Predict(static_cast<int>(disc), sighting, focal_px, some);
      if (some.empty()) continue;
      const auto best = std::max_element(some.begin(), some.end(), ByScore);
      if (dut_.unique_ && best->score > promising) quick = fit_.Grow(best->view);
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

std::string DiscLabeller::Search::WhyNot() const {
  const std::size_t needed = fit_.Needed();
  if (detections_.size() < needed) {
    return fmt::format("only {} disc-like spots in the image, {} are needed", detections_.size(), needed);
  }
  if (fit_.most_labels() > 0) {
    return fmt::format("the best arrangement explains {} discs, {} are needed", fit_.most_labels(), needed);
  }
  return fmt::format("no arrangement of the {} bright spots looks like the object", detections_.size());
}

Outcome<Labelling> DiscLabeller::Search::Run() {
  if (!fit_.Enough(detections_.size())) return Refusal{WhyNot()};
  for (const int anchor : Anchors()) {
    std::optional<Labelling> best;
    const std::vector<Hypothesis> hypotheses = Hypotheses(anchor, best);
    for (const Hypothesis& h : hypotheses) {
      if (best && MostlyAgree(fit_.Match(h.view, LabelFit::kLoose, 3, LabelFit::kSizeLoose), best->labels))
        continue;
      const std::optional<Labelling> next = fit_.Grow(h.view);
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
