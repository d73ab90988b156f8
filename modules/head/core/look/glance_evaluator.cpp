#include "head/core/look/glance_evaluator.hpp"

#include "head/core/look/usable_image.hpp"

namespace priamos::head {

std::vector<DoorSighting> GlanceEvaluator::FindDoors(const StereoViews& views,
                                                     const StereoPictures& pictures) const {
  std::vector<DoorSighting> sightings;
  for (const DetectedDoor& door : DetectDoors(views[0], views[1], options_.detection)) {
    DoorSighting sighting{door, {}};
    const OpeningShape opening{door.base_from_door, door.width_m, door.height_m};
    if (door.base_from_door.translation().norm() < options_.max_state_m)
      sighting.state = StateOf(opening, SurfacesIn(opening, pictures, options_.surfaces), options_.state);
    sightings.push_back(sighting);
  }
  return sightings;
}

Glance GlanceEvaluator::Evaluate(const std::array<std::optional<GreyImage>, 2>& images,
                                 const HeadSetting& setting, bool with_doors) {
  const auto left = head_.CameraAt(setting, kLeft), right = head_.CameraAt(setting, kRight);
  if (!left || !right || !IsUsable(images[0]) || !IsUsable(images[1])) return {};
  for (int i = 0; i < 2; ++i) edge_operator_.Extract(Wrap(*images[i]), edges_[i]);
  const StereoViews views{MakeView(*left, edges_[0]), MakeView(*right, edges_[1])};
  Glance glance;
  if (with_doors) glance.doors = FindDoors(views, {{&*images[0], &*images[1]}, {&*left, &*right}});
  glance.scene =
      ReconstructScene(views, MatchBinocular(views[0], views[1], options_.scene.stereo), options_.scene);
  return glance;
}

}  // namespace priamos::head
