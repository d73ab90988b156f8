#pragma once

#include "head/core/landmark/edge_association.hpp"

namespace priamos::head {

/// How much of a body that was found agrees with the images. A pose by chance, or another body of its kind,
/// explains some edges as well as the right one does; but it covers less of them, and they end elsewhere.
struct BodyAgreement {
  double covered =
      0;            ///< covered share of the predicted length, all images together, long edges counted less
  double ends = 0;  ///< share of the ends in view of the edges found that the images show there

  /// What tells right poses from wrong ones, with `misfit`, the variance of the edges over the one that is
  /// expected of them. The weights come from poses of made-up bodies, sharp and blurred, right and wrong
  /// (FIGURES.md).
  double Value(double misfit) const;
};

/// `blur_px` of the images: ends are not found better than that allows.
BodyAgreement AgreementOf(const Association& association, double blur_px);

}  // namespace priamos::head
