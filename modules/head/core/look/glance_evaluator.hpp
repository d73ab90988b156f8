#pragma once

#include <array>
#include <optional>
#include <vector>

#include "common/frame_store.hpp"
#include "head/core/camera/head_model.hpp"
#include "head/core/doors/door_tracks.hpp"
#include "head/core/edges/edge_segments.hpp"
#include "head/core/scene/scene_objects.hpp"

namespace priamos::head {

/// What a glance showed, base frame.
struct Glance {
  std::vector<DoorSighting> doors;
  Scene scene;
};

/// Settings of a glance's evaluation.
struct GlanceOptions {
  EdgeOperator::Options edges = DoorEdges();
  DoorDetectionOptions detection;
  SurfaceOptions surfaces;
  DoorStateOptions state;
  double max_state_m = 4;  ///< of farther doors the state is not looked for
  SceneOptions scene;
};

/// Evaluates stereo pairs that were taken in passing, of no landmark: doors without a map, whether they are
/// open, and what else stands there. Of earlier ones it keeps its buffers only.
class GlanceEvaluator {
 public:
  GlanceEvaluator(const HeadModel& head, const GlanceOptions& options)
      : head_(head), options_(options), edge_operator_(options.edges) {}

  /// What pictures taken with the motors at `setting` show, left, right and third; nothing without the first
  /// two and a calibration there. Doors are looked for `with_doors`.
  Glance Evaluate(const std::array<std::optional<GreyImage>, 3>& images, const HeadSetting& setting,
                  bool with_doors);

 private:
  std::vector<DoorSighting> FindDoors(const StereoViews& views, const StereoPictures& pictures) const;

  HeadModel head_;
  GlanceOptions options_;
  EdgeOperator edge_operator_;
  std::optional<CameraModel> ThirdCamera(const std::optional<GreyImage>& image, const HeadSetting& setting);
  std::array<EdgeImage, 3> edges_;
};

}  // namespace priamos::head
