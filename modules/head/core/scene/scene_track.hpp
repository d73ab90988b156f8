#pragma once

#include "common/time.hpp"
#include "head/core/scene/scene_object.hpp"
#include "head/core/tracks/tracked_place.hpp"

namespace priamos::head {

/// Something that stands on the floor, as all looks that showed it put it together.
struct SceneTrack {
  int id = 0;
  Time seen{};         ///< exposure of the newest of them
  TrackedPlace place;  ///< middle of its front; x square to it, away from where it was seen
  SceneObject object;  ///< kind, measures and sigma of its yaw; its place means nothing
  int looks = 0;
  int through = 0;            ///< looks since then that saw through where it stood
  Pose2 map_from_first_base;  ///< from where it was seen first
};

}  // namespace priamos::head
