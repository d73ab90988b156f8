#include "robot/core/pose/slip_scale.hpp"

#include <algorithm>
#include <cmath>

#include "common/square.hpp"

namespace priamos::robot {
namespace {

/// Of the logarithm of the factor: wheels slip half as much as configured, or three times.
constexpr double kPriorSigma = 1.25;
constexpr double kFirst = -2, kStep = 0.16;  ///< logarithms: from 1/2.7 to 4 times the slip

}  // namespace

double SlipEvidence::LogFactor(int k) {
  return kFirst + k * kStep;
}

bool SlipEvidence::Add(const SlipResidual& residual) {
  for (int k = 0; k < kFactors; ++k) {
    const double variance = std::exp(LogFactor(k)) * residual.by_slip + residual.by_fixes;
    // Written so that NaN is refused.
    if (!(variance > 0) || !std::isfinite(residual.change)) return false;
    Sums& sums = sums_[static_cast<std::size_t>(k)];
    sums.log_variances += std::log(variance);
    sums.squares += Square(residual.change) / variance;
    sums.lever += Square(residual.forward_m) / variance;
    sums.constant += residual.forward_m * residual.change / variance;
  }
  return true;
}

/// The residuals share the constant error: their covariance has rank one more, and is inverted by Sherman and
/// Morrison.
double SlipEvidence::LogLikelihood(int k) const {
  const Sums& sums = sums_[static_cast<std::size_t>(k)];
  const double prior = Square(constant_sigma_), common = 1 + prior * sums.lever;
  return -(sums.log_variances + std::log(common) + sums.squares - prior * Square(sums.constant) / common) / 2;
}

void SlipScale::Add(SlipEvidence& evidence, const SlipResidual& residual) {
  if (evidence.Add(residual)) told_ = true;
}

double SlipScale::LogPosterior(int k) const {
  return turn_.LogLikelihood(k) + across_.LogLikelihood(k) -
         Square(SlipEvidence::LogFactor(k) / kPriorSigma) / 2;
}

double SlipScale::factor() const {
  if (!told_) return 1;
  std::array<double, SlipEvidence::kFactors> log_posterior{};
  for (int k = 0; k < SlipEvidence::kFactors; ++k)
    log_posterior[static_cast<std::size_t>(k)] = LogPosterior(k);
  const double most = *std::ranges::max_element(log_posterior);
  double weights = 0, sum = 0;
  for (int k = 0; k < SlipEvidence::kFactors; ++k) {
    const double weight = std::exp(log_posterior[static_cast<std::size_t>(k)] - most);
    weights += weight;
    sum += weight * std::exp(SlipEvidence::LogFactor(k));
  }
  return sum / weights;
}

}  // namespace priamos::robot
