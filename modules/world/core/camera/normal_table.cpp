#include "world/core/camera/normal_table.hpp"

#include <array>
#include <cmath>

namespace priamos::world {

namespace {

constexpr int kSteps = 1 << 16;

/// Quantiles in the middle of each step, by Newton's method on the distribution function.
std::array<float, kSteps> Quantiles() {
  std::array<float, kSteps> table;
  double x = 0;
  for (int i = kSteps / 2; i < kSteps; ++i) {
    const double p = (i + 0.5) / kSteps;
    for (int k = 0; k < 50; ++k) {
      const double error = 0.5 * std::erfc(-x / std::sqrt(2.0)) - p;
      const double step = error / (std::exp(-0.5 * x * x) * 0.3989422804014327);
      x -= step;
      if (std::abs(step) < 1e-9) break;
    }
    table[i] = static_cast<float>(x);
    table[kSteps - 1 - i] = static_cast<float>(-x);
  }
  return table;
}

}  // namespace

NormalTable::NormalTable(Rng& rng) : rng_(rng) {}

double NormalTable::Draw() {
  static const std::array<float, kSteps> kTable = Quantiles();
  if (left_ == 0) {
    bits_ = rng_.engine()();
    left_ = 4;
  }
  const auto index = static_cast<std::uint16_t>(bits_);
  bits_ >>= 16;
  --left_;
  return kTable[index];
}

}  // namespace priamos::world
