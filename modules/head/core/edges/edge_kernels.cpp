#include "head/core/edges/edge_kernels.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/geometry.hpp"

namespace priamos::head {
namespace {

constexpr double kWideSigma = 1.2, kNarrowSigma = 0.8;
constexpr int kSlopes = 8;

double Normal(double z) {
  return std::exp(-z * z / 2) / std::sqrt(2 * kPi);
}

/// Derivatives, in the position x, of the weight that a pixel at x + u has.
std::array<double, 3> Derivatives(double u, double sigma) {
  const double above = (u + 0.5) / sigma, below = (u - 0.5) / sigma;
  const double first = (Normal(above) - Normal(below)) / sigma;
  const double second = (below * Normal(below) - above * Normal(above)) / (sigma * sigma);
  const double third =
      ((above * above - 1) * Normal(above) - (below * below - 1) * Normal(below)) / std::pow(sigma, 3);
  return {-first, second, -third};
}

/// A constant row must give exactly 0 although the weights are rounded.
void MakeZeroSum(std::array<std::int16_t, EdgeKernel::kTaps>& weights) {
  int sum = 0;
  for (const int w : weights) sum += w;
  weights[EdgeKernel::kCentre] -= sum / 2;
  weights[EdgeKernel::kCentre + 1] -= sum - sum / 2;
}

EdgeKernel MakeKernel(double sigma, double phase) {
  EdgeKernel kernel;
  for (int i = 0; i < EdgeKernel::kTaps; ++i) {
    const auto d = Derivatives(i - EdgeKernel::kCentre - phase, sigma);
    kernel.first[i] = static_cast<std::int16_t>(std::lround(d[0] * EdgeKernel::kScale));
    kernel.second[i] = static_cast<std::int16_t>(std::lround(d[1] * EdgeKernel::kScale));
    kernel.third[i] = static_cast<std::int16_t>(std::lround(d[2] * EdgeKernel::kScale));
  }
  MakeZeroSum(kernel.first);
  MakeZeroSum(kernel.second);
  MakeZeroSum(kernel.third);
  return kernel;
}

double Gain(const std::array<std::int16_t, EdgeKernel::kTaps>& weights) {
  double sum = 0;
  for (const double w : weights) sum += w * w;
  return sum / (EdgeKernel::kScale * EdgeKernel::kScale);
}

std::vector<EdgeKernelSet> MakeAll(double sigma) {
  std::vector<EdgeKernelSet> sets;
  sets.reserve(kSlopes);
  for (int i = 0; i < kSlopes; ++i) {
    sets.emplace_back(sigma * (1 + (std::sqrt(2.0) - 1) * (i + 0.5) / kSlopes));
  }
  return sets;
}

}  // namespace

EdgeKernelSet::EdgeKernelSet(double sigma) : sigma_px(sigma) {
  for (int p = 0; p < kPhases; ++p) phases[p] = MakeKernel(sigma, (p + 0.5) / kPhases);
  first_gain = Gain(phases[0].first);
  second_gain = Gain(phases[0].second);
}

const EdgeKernelSet& KernelsFor(KernelWidth width, double slope) {
  static const std::array<std::vector<EdgeKernelSet>, 2> kSets{MakeAll(kWideSigma), MakeAll(kNarrowSigma)};
  const double stretch = (std::sqrt(1 + slope * slope) - 1) / (std::sqrt(2.0) - 1);
  return kSets[static_cast<int>(width)][std::clamp(static_cast<int>(stretch * kSlopes), 0, kSlopes - 1)];
}

}  // namespace priamos::head
