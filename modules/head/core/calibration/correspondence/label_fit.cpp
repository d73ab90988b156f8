#include "head/core/calibration/correspondence/label_fit.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::head {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSizeStrict = 1.10;  // at last, beside kSizeSlack_px
constexpr double kSizeSlack_px = 0.45;
constexpr std::size_t kFewestLabels = 7;

/// The radius of the circle that has the area of the disc's image; 0 if the disc cannot be seen.
double MeanRadius(const PinholeView& view, const ReferenceDisc& disc) {
  const std::optional<Ellipse> ellipse = ProjectDisc(view.Model().image_from_base, disc);
  if (!ellipse) return 0;
  // The lens scales areas by about (1 + k1 r^2) (1 + 3 k1 r^2).
  const double r2 = view.InCamera(disc.centre_m).hnormalized().squaredNorm();
  return std::sqrt(ellipse->Area() / kPi) * (1 + 2 * view.k1 * r2);
}

}  // namespace

LabelFit::LabelFit(const ReferenceObject& object, const LabellerOptions& options,
                   const std::vector<double>& spacing_m, const std::vector<DetectedDisc>& detections)
    : object_(object), options_(options), spacing_m_(spacing_m), detections_(detections) {
  for (const DetectedDisc& d : detections) mean_px_.push_back(std::sqrt(d.ellipse.Area() / kPi));
}

std::size_t LabelFit::Needed() const {
  const std::size_t discs = object_.discs.size();
  return std::max<std::size_t>(kFewestLabels, discs - std::min<std::size_t>(discs, options_.max_hidden));
}

bool LabelFit::Enough(std::size_t labels) const {
  return labels >= Needed();
}

LensPrior LabelFit::Prior(bool whole_lens) const {
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

std::vector<DiscLabel> LabelFit::Match(const PinholeView& view, double share, double least_px,
                                       double size_ratio) const {
  std::vector<DiscLabel> labels;
  std::vector<double> misses;
  for (std::size_t disc = 0; disc < object_.discs.size(); ++disc) {
    const ReferenceDisc& d = object_.discs[disc];
    const Vector3d in_camera = view.InCamera(d.centre_m);
    if (in_camera.z() < 0.1) continue;
    const double px_per_m = view.focal_px / in_camera.z();
    double miss = std::max(least_px, share * spacing_m_[disc] * px_per_m);
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

int LabelFit::Nearest(const Vector2d& px, double radius_px, double size_ratio, double& miss) const {
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

std::vector<PointPair> LabelFit::Pairs(const std::vector<DiscLabel>& labels,
                                       const PinholeView* bias_of) const {
  std::vector<PointPair> pairs;
  for (const auto& [disc, detection] : labels) {
    PointPair pair{object_.discs[disc].centre_m, detections_[detection].ellipse.centre_px};
    if (bias_of) pair.image_px -= CentroidBias(bias_of->Model(), object_.discs[disc]);
    pairs.push_back(pair);
  }
  return pairs;
}

std::optional<Labelling> LabelFit::Grow(PinholeView view) const {
  double share = kLoose;
  for (int round = 0; round < 4; ++round, share *= 0.6) {
    const auto labels = Match(view, share, 3, kSizeLoose);
    if (labels.size() < 5) return std::nullopt;
    const std::vector<PointPair> pairs = Pairs(labels, nullptr);
    // Wrong pairs are still among them: errors beyond a share of the tolerance lose weight.
    const double sigma_px = std::max(
        1.0, 0.25 * share * spacing_m_[labels[0].disc] * view.focal_px / view.InCamera(pairs[0].point_m).z());
    FitView(view, pairs, Prior(labels.size() >= 9), 3, sigma_px);
    if (!view.offset_m.allFinite() || view.focal_px < 0.5 * options_.min_focal_px ||
        view.focal_px > 2 * options_.max_focal_px) {
      return std::nullopt;
    }
  }
  return Verify(view);
}

std::optional<Labelling> LabelFit::Verify(PinholeView view) const {
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
  std::vector<DiscLabel> kept;
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

}  // namespace priamos::head
