#pragma once

#include <array>
#include <optional>
#include <vector>

#include "common/frame_store.hpp"
#include "head/core/camera/head_model.hpp"
#include "head/core/doors/door_tracks.hpp"
#include "head/core/edges/edge_segments.hpp"

namespace priamos::head {

/// Settings of a glance's evaluation.
struct GlanceOptions {
  EdgeOperator::Options edges = DoorEdges();
  DoorDetectionOptions detection;
  SurfaceOptions surfaces;
  DoorStateOptions state;
  double max_state_m = 4;  ///< of farther doors the state is not looked for
};

/// Evaluates stereo pairs that were taken in passing, of no landmark: doors without a map, and whether they
/// are open. Of earlier ones it keeps its buffers only.
class GlanceEvaluator {
 public:
  GlanceEvaluator(const HeadModel& head, const GlanceOptions& options)
      : head_(head), options_(options), edge_operator_(options.edges) {}

  /// The doors in a pair taken with the motors at `setting`, base frame; none without both pictures and a
  /// calibration there.
  std::vector<DoorSighting> Evaluate(const std::array<std::optional<GreyImage>, 2>& images,
                                     const HeadSetting& setting);

 private:
  HeadModel head_;
  GlanceOptions options_;
  EdgeOperator edge_operator_;
  std::array<EdgeImage, 2> edges_;
};

}  // namespace priamos::head
