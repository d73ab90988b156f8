#include "robot/core/pose/slip_scale.hpp"

#include <algorithm>
#include <cmath>

#include "common/square.hpp"

namespace priamos::robot {
namespace {

/// Of the logarithm of the factor: wheels slip half as much as configured, or three times.
constexpr double kPriorSigma = 1.25, kPriorMean = 0;
constexpr double kFirst = -2, kStep = 0.16;     ///< logarithms: from 1/2.7 to 4 times the slip
constexpr double kTurnSigma_rad_per_m = 0.004;  ///< constant, and unknown

double LogFactor(int k) {
  return kFirst + k * kStep;
}

}  // namespace

void SlipScale::Add(double change_rad, double by_slip, double by_fixes, double forward_m) {
  for (int k = 0; k < kFactors; ++k) {
    const double variance = std::exp(LogFactor(k)) * by_slip + by_fixes;
    // Written so that NaN is refused.
    if (!(variance > 0) || !std::isfinite(change_rad)) return;
    told_ = true;
    Evidence& e = evidence_[static_cast<std::size_t>(k)];
    e.log_variances += std::log(variance);
    e.squares += Square(change_rad) / variance;
    e.lever += Square(forward_m) / variance;
    e.turn += forward_m * change_rad / variance;
  }
}

/// The pairs share the constant turn: its covariance has rank one, and is inverted by Sherman and Morrison.
double SlipScale::LogPosterior(int k) const {
  const Evidence& e = evidence_[static_cast<std::size_t>(k)];
  const double prior = Square(kTurnSigma_rad_per_m), common = 1 + prior * e.lever;
  const double squares = e.squares - prior * Square(e.turn) / common;
  return -(e.log_variances + std::log(common) + squares + Square((LogFactor(k) - kPriorMean) / kPriorSigma)) /
         2;
}

double SlipScale::factor() const {
  if (!told_) return 1;
  std::array<double, kFactors> log_posterior{};
  for (int k = 0; k < kFactors; ++k) log_posterior[static_cast<std::size_t>(k)] = LogPosterior(k);
  const double most = *std::ranges::max_element(log_posterior);
  double weights = 0, sum = 0;
  for (int k = 0; k < kFactors; ++k) {
    const double weight = std::exp(log_posterior[static_cast<std::size_t>(k)] - most);
    weights += weight;
    sum += weight * std::exp(LogFactor(k));
  }
  return sum / weights;
}

}  // namespace priamos::robot
