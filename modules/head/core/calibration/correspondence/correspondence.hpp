#pragma once

#include <vector>

#include "common/outcome.hpp"
#include "common/reference_object.hpp"
#include "head/core/calibration/correspondence/labelling.hpp"
#include "head/core/calibration/discs/disc_fit.hpp"

namespace priamos::head {

/// Finds which detected disc is which disc of the object, from one image and without a first guess.
///
/// One ellipse of known radius gives its disc's distance and, up to mirroring, its tilt; with the roll and
/// the focal length sampled, one detection that is taken for one disc already predicts the whole image. The
/// predictions that meet the most detections are fitted, extended and fitted again. A labelling is accepted
/// only if enough discs lie within a fraction of a pixel and have the right size, and if no other labelling
/// of the same image does as well.
class DiscLabeller {
 public:
  /// Labeller for the discs of `object`, given in its own frame, its z axis roughly upwards in the images.
  explicit DiscLabeller(const ReferenceObject& object, const LabellerOptions& options = {});

  /// The right labelling, or a refusal with the reason.
  Outcome<Labelling> Label(const std::vector<DetectedDisc>& detections) const;

 private:
  class Search;
  /// Position of another disc relative to a disc, and its size.
  struct Neighbour {
    Eigen::Vector3d offset_m;  ///< along that disc's normal, upwards across it, and the third axis
    double spacing_m;          ///< from the other disc to the one nearest to it
    double radius_m;
  };

  std::vector<Neighbour> NeighboursOf(const ReferenceDisc& disc) const;
  /// Labels a made-up front view without any short cut.
  bool IsUnique() const;

  ReferenceObject object_;
  LabellerOptions options_;
  std::vector<double> spacing_m_;                   ///< to the nearest other disc
  std::vector<std::vector<Neighbour>> neighbours_;  ///< neighbours of every disc, nearest first
  std::vector<Eigen::Vector2d> rolls_;              ///< (cos, sin) of the rolls to try
  bool unique_ = false;  ///< no second arrangement fits a front view: the first good one may be taken
};

}  // namespace priamos::head
