#pragma once

#include <cstdint>
#include <random>
#include <string_view>

namespace priamos {

/// Seeded random source. It is passed in, never global, so that yesterday's failure can be run again.
class Rng {
 public:
  explicit Rng(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [low, high).
  double Uniform(double low, double high) { return std::uniform_real_distribution<>(low, high)(engine_); }
  /// Normal with mean 0; sigma 0 gives exactly 0 (and still consumes nothing).
  double Normal(double sigma) { return sigma > 0 ? std::normal_distribution<>(0, sigma)(engine_) : 0.0; }
  bool Chance(double probability) { return Uniform(0, 1) < probability; }
  /// Uniform integer in [0, n).
  std::uint64_t Below(std::uint64_t n) {
    return std::uniform_int_distribution<std::uint64_t>(0, n - 1)(engine_);
  }

  /// An independent stream for one named part, so that adding a draw in one part does not shift another.
  static Rng Stream(std::uint64_t seed, std::string_view part);

  std::mt19937_64& engine() { return engine_; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace priamos
