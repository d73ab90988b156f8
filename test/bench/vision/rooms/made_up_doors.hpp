#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "test/bench/vision/landmark_looks.hpp"

namespace priamos::bench {

/// What is wrong with a made-up building: nothing; the wall goes on where the door should be; or the door
/// there is broader or narrower than the plan says by 6 to 15 cm; or the light comes from elsewhere.
enum class RoomTrouble { kNone, kDoorAbsent, kAnotherDoor, kOtherLight };
const char* Describe(RoomTrouble trouble);

/// A look at the door to pass of a building that was made up from the look's seed.
struct RoomLook {
  LandmarkLook look;
  std::string wall, floor;  ///< materials
};

/// Draws stereo pairs in rooms and floors of `priamos world generate`, 2.0 to 3.4 m before the door to pass.
/// The model is that of the surveyed plan: every dimension as a person with a tape has it, the opening up to
/// 2 cm narrower than drawn.
class RoomPhotographer {
 public:
  RoomPhotographer();
  /// `kind` as in world::GeneratedKinds: "room" or "floor"; `visit` as in LookStage.
  RoomLook Take(const std::string& kind, std::uint64_t seed, RoomTrouble trouble, const CalibratedHead& head,
                int visit = 0);

 private:
  std::shared_ptr<void> graphics_;
};

}  // namespace priamos::bench
