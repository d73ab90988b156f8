#pragma once

#include <array>
#include <cstdint>

#include "common/archive.hpp"
#include "world/core/camera/optics.hpp"

namespace priamos::world {

/// How the three cameras differ from each other and from what calibration can describe.
struct CameraQuirksPlan {
  double gain_spread = 0;      ///< each camera's gain is off by up to this part
  double gain_drift = 0;       ///< and wanders by this part, one sigma
  double gain_drift_s = 60;    ///< time after which it has forgotten where it was
  double defocus_dioptre = 0;  ///< each lens is set wrong by up to this
  double decentring = 0;       ///< tangential distortion of each lens, up to this
  double k3 = 0;               ///< radial distortion of seventh order, up to this

  void Describe(Archive& a);
};

/// The quirks of one camera in this run.
struct CameraQuirk {
  double gain = 1;
  double defocus_dioptre = 0;
  double p1 = 0, p2 = 0, k3 = 0;
};

/// The quirks of all cameras in this run.
struct CameraQuirks {
  std::array<CameraQuirk, kCameras> cameras;
  double gain_drift = 0, gain_drift_s = 60;
};

/// Draws them from the seed.
CameraQuirks DrawQuirks(const CameraQuirksPlan& plan, std::uint64_t seed);

/// The head with the lenses' form of distortion.
HeadBuild WithQuirks(HeadBuild head, const CameraQuirks& quirks);

}  // namespace priamos::world
