#pragma once

#include <optional>
#include <vector>

#include "common/reference_object.hpp"
#include "head/core/calibration/correspondence/labelling.hpp"
#include "head/core/calibration/discs/disc_fit.hpp"

namespace priamos::head {

/// Turns a rough view of the object into a labelling of one image, or finds that it is none.
class LabelFit {
 public:
  static constexpr double kLoose = 0.3;       ///< first tolerance, as a share of the spacing of the discs
  static constexpr double kSizeLoose = 1.35;  ///< ratio of predicted and measured radius at first

  /// Fit of a camera to labels. `spacing_m`: distance of every disc to the nearest other [m]. Keeps
  /// references to all.
  LabelFit(const ReferenceObject& object, const LabellerOptions& options,
           const std::vector<double>& spacing_m, const std::vector<DetectedDisc>& detections);

  /// Detections that lie where the view shows discs, within `share` of the spacing but at least `least_px`.
  std::vector<DiscLabel> Match(const PinholeView& view, double share, double least_px,
                               double size_ratio) const;
  /// Fits the view to ever more labels; nullopt if the result fails the strict test.
  std::optional<Labelling> Grow(PinholeView view) const;
  /// Whether a labelling with so many labels is accepted.
  bool Enough(std::size_t labels) const;
  /// Least number of labels of an accepted labelling.
  std::size_t Needed() const;
  /// Largest number of labels that a view has reached, for messages.
  std::size_t most_labels() const { return most_labels_; }

 private:
  /// The nearest detection of similar size within `miss`, which becomes its distance; -1 if none.
  int Nearest(const Eigen::Vector2d& px, double radius_px, double size_ratio, double& miss) const;
  std::vector<PointPair> Pairs(const std::vector<DiscLabel>& labels, const PinholeView* bias_of) const;
  std::optional<Labelling> Verify(PinholeView view) const;
  LensPrior Prior(bool whole_lens) const;

  const ReferenceObject& object_;
  const LabellerOptions& options_;
  const std::vector<double>& spacing_m_;
  const std::vector<DetectedDisc>& detections_;
  std::vector<double> mean_px_;  ///< radius of the circle of a detection's area
  mutable std::size_t most_labels_ = 0;
};

/// Whether two sizes differ by less than a ratio.
inline bool SimilarSize(double a, double b, double ratio) {
  return a < b * ratio && b < a * ratio;
}

}  // namespace priamos::head
