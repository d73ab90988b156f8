#pragma once

#include "head/core/scene/scene_track.hpp"

namespace priamos::head {

/// Whether it is the top of something that hangs, or a border of one: thin, and off the floor.
bool Hangs(const SceneObject& object);

/// Whether two that hang are one: of one height, and the middle of either lies within the other. What is seen
/// of a top from near is a part of it, and another side is its front.
bool AreOneTop(const SceneTrack& a, const SceneTrack& b);

/// Puts a top where a look showed it: the larger part counts; of parts as large the mean, if they have the
/// same front.
void JoinTop(const SceneTrack& seen, const PlaceOptions& options, SceneTrack& track);

}  // namespace priamos::head
