#include "head/core/look/glance_evaluator.hpp"

#include <algorithm>
#include <iterator>

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

/// The third camera, where it is calibrated and its picture is of use; extracts its edges.
std::optional<CameraModel> GlanceEvaluator::ThirdCamera(const std::optional<GreyImage>& image,
                                                        const HeadSetting& setting) {
  const auto third = head_.CameraAt(setting, kThird);
  if (!third || !IsUsable(image)) return std::nullopt;
  edge_operator_.Extract(Wrap(*image), edges_[kThird]);
  return *third;
}

Glance GlanceEvaluator::Evaluate(const std::array<std::optional<GreyImage>, 3>& images,
                                 const HeadSetting& setting, bool with_doors) {
  const auto left = head_.CameraAt(setting, kLeft), right = head_.CameraAt(setting, kRight);
  if (!left || !right || !IsUsable(images[0]) || !IsUsable(images[1])) return {};
  for (int i = 0; i < 2; ++i) edge_operator_.Extract(Wrap(*images[i]), edges_[i]);
  const StereoViews views{MakeView(*left, edges_[0]), MakeView(*right, edges_[1])};
  Glance glance;
  if (with_doors) glance.doors = FindDoors(views, {{&*images[0], &*images[1]}, {&*left, &*right}});
  std::vector<StereoMatch> matches = MatchBinocular(views[0], views[1], options_.scene.stereo);
  const auto third = ThirdCamera(images[kThird], setting);
  if (!third) {
    glance.scene = ReconstructScene(views, matches, options_.scene);
    return glance;
  }
  const CameraView above = MakeView(*third, edges_[kThird]);
  std::ranges::move(MatchTrinocular(views[0], views[1], above, options_.scene.stereo),
                    std::back_inserter(matches));
  glance.scene = ReconstructScene(views, matches, options_.scene, &above);
  return glance;
}

}  // namespace priamos::head
