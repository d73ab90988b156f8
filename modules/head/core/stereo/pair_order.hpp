#pragma once

#include "head/core/stereo/stereo_pairs.hpp"
#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// What two images say of the order in which they are given.
enum class PairVerdict {
  kRight,      ///< they fit their cameras
  kUnknown,    ///< no edge of space is in both, in neither order
  kExchanged,  ///< each fits the other one's camera
  kSameView,   ///< nearly the same image twice: what two cameras see from different places cannot be so alike
};

/// The evidence for a verdict.
struct PairOrder {
  PairVerdict verdict = PairVerdict::kRight;
  int n_as_given = 0, n_exchanged = 0;  ///< edges of space, of the images as they are and exchanged
  double as_given = 0, exchanged = 0;   ///< the same, weighed by length and similarity
  int n_still = 0, n_should_move = 0;   ///< lines of the first image that have a partner at the same place in
                                        ///< the second; of all lines that no edge of space would show there
};

/// Whether two images belong to their cameras in this order. An exchanged pair shows everything behind the
/// cameras, so that only chance finds partners; of one image seen twice (also moved by a pixel or two, with
/// other noise, compressed again, brighter or darker) the lines stand still where a change of place must move
/// them.
PairOrder JudgeOrder(const CameraView& first, const CameraView& second, const StereoOptions& options);

}  // namespace priamos::head
