#pragma once

#include <array>
#include <optional>

#include "common/random.hpp"
#include "common/time.hpp"
#include "world/core/scene/camera_quirks.hpp"

namespace priamos::world {

/// The gain of each camera: a part that is fixed, and one that wanders as its amplifier warms up and the
/// lamps flicker (an Ornstein-Uhlenbeck process of its own per camera).
class GainDrift {
 public:
  GainDrift(const CameraQuirks& quirks, Rng rng) : quirks_(quirks), rng_(rng) {}

  /// Factor of the nominal gain at `time`; times of one camera do not go back.
  double At(Camera camera, Time time);

 private:
  struct Wander {
    std::optional<Time> time;
    double part = 0;
  };

  CameraQuirks quirks_;
  Rng rng_;
  std::array<Wander, kCameras> wanders_;
};

}  // namespace priamos::world
