#include "world/core/head/gain_drift.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::world {
namespace {

constexpr double kLeastGain = 0.05;  ///< of the nominal one: an amplifier does not turn the picture over

}  // namespace

double GainDrift::At(Camera camera, Time time) {
  const auto i = static_cast<std::size_t>(camera);
  Wander& wander = wanders_[i];
  const double kept =
      wander.time ? std::exp(-Seconds(std::max(time - *wander.time, Duration(0))) / quirks_.gain_drift_s) : 0;
  wander.part = kept * wander.part + rng_.Normal(quirks_.gain_drift * std::sqrt(1 - kept * kept));
  wander.time = time;
  return std::max(quirks_.cameras[i].gain * (1 + wander.part), kLeastGain);
}

}  // namespace priamos::world
