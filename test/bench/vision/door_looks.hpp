#pragma once

#include <cstdint>
#include <memory>

#include "test/bench/vision/landmark_looks.hpp"

namespace priamos::bench {

/// What is wrong with the scene, or nothing.
enum class Trouble { kNone, kDoorAbsent, kAnotherDoor, kHalfHidden, kLeafMoved, kLightsOut, kOtherLight };
inline constexpr Trouble kTroubles[] = {Trouble::kDoorAbsent, Trouble::kAnotherDoor, Trouble::kHalfHidden,
                                        Trouble::kLeafMoved, Trouble::kLightsOut};
const char* Describe(Trouble trouble);

/// The model of a map that tells the leaf's angle.
head::LandmarkModel ModelWithLeaf(double open_deg);

/// A look at the door, things in which are as sharp as they are distant.
struct LensTrial {
  double distance_m = 2.4;  ///< of the head
  double doubt = 1;         ///< LookStage::doubt
  bool choose = false;      ///< zoom and focus for this look
  const char* wall = "plaster";
};

/// Draws stereo pairs of the door of config/sim/worlds/door.toml, 2.4 m before the head. Furniture, light,
/// textures, noise and the leaf's angle follow the seed.
class DoorPhotographer {
 public:
  DoorPhotographer();
  LandmarkLook Take(std::uint64_t seed, Trouble trouble, const CalibratedHead& head,
                    const LookTolerances& tolerances = {}, int side = 0, int visit = 0);
  /// From elsewhere, or with a lens that is chosen.
  LandmarkLook Take(std::uint64_t seed, const LensTrial& trial, const CalibratedHead& head);

 private:
  std::shared_ptr<void> graphics_;
};

}  // namespace priamos::bench
