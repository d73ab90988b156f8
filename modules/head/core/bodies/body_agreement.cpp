#include "head/core/bodies/body_agreement.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace priamos::head {
namespace {

/// Weights beside that of the covered share, which is 1.
constexpr double kEnds = 0.66, kMisfit = 0.049;
constexpr double kLeastMisfit = 0.01;          ///< less says no more: it is as good as exact
constexpr double kEnd_px = 4, kEndByBlur = 2;  ///< an end is found so near to where the model has it

}  // namespace

double BodyAgreement::Value(double misfit) const {
  return covered + kEnds * ends - kMisfit * std::log(std::max(kLeastMisfit, misfit));
}

BodyAgreement AgreementOf(const Association& association, double blur_px) {
  const double near_px = kEnd_px + kEndByBlur * blur_px;
  double covered_px = 0;
  int n_ends = 0, n_near = 0;
  for (const EdgeMatch& match : association.matches) {
    covered_px += match.covered * std::min(kFullLength_px, match.predicted_px);
    for (int end : {0, 1}) {
      n_ends += match.is_end_in_view[end];
      n_near += match.is_end_in_view[end] && std::abs(match.gap_px[end]) < near_px;
    }
  }
  const auto& predicted = association.side_predicted_px;
  const double predicted_px = std::accumulate(predicted.begin(), predicted.end(), 0.0);
  return {.covered = predicted_px > 0 ? covered_px / predicted_px : 0,
          .ends = n_ends > 0 ? static_cast<double>(n_near) / n_ends : 0};
}

}  // namespace priamos::head
