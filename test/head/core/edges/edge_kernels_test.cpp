#include "head/core/edges/edge_kernels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace priamos::head {
namespace {

/// Response to grey values given as a function of the distance from the line [px].
template <class F>
double Respond(const std::array<std::int16_t, EdgeKernel::kTaps>& weights, double phase, F grey) {
  double sum = 0;
  for (int i = 0; i < EdgeKernel::kTaps; ++i) sum += weights[i] * grey(i - EdgeKernel::kCentre - phase);
  return sum / EdgeKernel::kScale;
}

TEST(EdgeKernelTest, IgnoresConstantsAndMeasuresSlopes) {
  for (const KernelWidth width : {KernelWidth::kWide, KernelWidth::kNarrow}) {
    for (const double slope : {0.0, 0.4, 1.0}) {
      const EdgeKernelSet& set = KernelsFor(width, slope);
      for (int p = 0; p < EdgeKernelSet::kPhases; p += 7) {
        const double phase = (p + 0.5) / EdgeKernelSet::kPhases;
        const EdgeKernel& dut = set.phases[p];
        EXPECT_EQ(std::accumulate(dut.first.begin(), dut.first.end(), 0), 0);
        EXPECT_EQ(std::accumulate(dut.second.begin(), dut.second.end(), 0), 0);
        EXPECT_EQ(std::accumulate(dut.third.begin(), dut.third.end(), 0), 0);
        EXPECT_NEAR(Respond(dut.first, phase, [](double u) { return u; }), 1, 0.01);
        EXPECT_NEAR(Respond(dut.second, phase, [](double u) { return u; }), 0, 0.01);
        EXPECT_NEAR(Respond(dut.second, phase, [](double u) { return u * u / 2; }), 1, 0.03);
      }
    }
  }
}

TEST(EdgeKernelTest, SecondDerivativeChangesSignAtTheEdge) {
  // A lens with a spread of 0.7 px, the edge 0.1 px beside the line.
  for (int p = 0; p < EdgeKernelSet::kPhases; p += 5) {
    const EdgeKernel& dut = KernelsFor(KernelWidth::kWide, 0).phases[p];
    const auto edge = [](double u) { return 100 * 0.5 * std::erfc(-(u - 0.1) / (0.7 * std::sqrt(2.0))); };
    const double phase = (p + 0.5) / EdgeKernelSet::kPhases;
    EXPECT_NEAR(-Respond(dut.second, phase, edge) / Respond(dut.third, phase, edge), 0.1, 0.004);
  }
}

TEST(EdgeKernelTest, SlantedLinesGetWiderKernels) {
  EXPECT_GT(KernelsFor(KernelWidth::kWide, 1.0).sigma_px, 1.3 * KernelsFor(KernelWidth::kWide, 0.0).sigma_px);
  EXPECT_GT(KernelsFor(KernelWidth::kWide, 0.0).sigma_px, KernelsFor(KernelWidth::kNarrow, 0.0).sigma_px);
}

}  // namespace
}  // namespace priamos::head
