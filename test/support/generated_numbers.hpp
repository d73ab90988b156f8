#pragma once

#include <rapidcheck.h>

#include <cstdint>

#include "common/random.hpp"

namespace priamos::support {

/// A number that rapidcheck chooses between two bounds, both included, and shrinks towards the lower one.
inline double Between(double low, double high) {
  constexpr int kSteps = 1'000'000;
  return low + (high - low) * *rc::gen::inRange(0, kSteps + 1) / kSteps;
}

/// A source of random numbers whose seed rapidcheck chooses: for what has too many numbers to shrink.
inline Rng GeneratedRng() {
  return Rng(static_cast<std::uint64_t>(*rc::gen::inRange(0, 1'000'000)));
}

}  // namespace priamos::support
