#pragma once

#include <array>
#include <map>
#include <optional>

#include "common/frame_store.hpp"
#include "head/core/camera/head_model.hpp"
#include "head/core/doors/leaf_sight.hpp"
#include "head/core/drift/stereo_drift.hpp"
#include "head/core/edges/edge_segments.hpp"
#include "head/core/landmark/landmark_fix.hpp"
#include "head/core/landmark/landmark_view.hpp"
#include "head/core/landmark/pose_history.hpp"
#include "head/core/look/far_edges.hpp"
#include "head/core/look/far_sight.hpp"
#include "head/core/look/landmark_memory.hpp"
#include "head/core/scene/scene_objects.hpp"

namespace priamos::head {

/// Input of a look's evaluation.
struct LookInput {
  const LandmarkModel* model = nullptr;  ///< model of the landmark ordered; nullptr: nobody has sent it
  std::optional<PoseSample> robot;       ///< estimated pose at the time of the exposure; nullopt: unknown
  std::array<std::optional<GreyImage>, 2> images;  ///< left, right; nullopt: lost
  HeadSetting setting;                             ///< counters of the motors during the exposure
  std::optional<GreyImage> third = {};             ///< of the third camera; nullopt: it does not take part
};

/// Evaluation of one look.
struct LookResult {
  LandmarkFix fix;                   ///< the fix, base frame; its verdict gives the reason if there is none
  int n_third = 0;                   ///< edges that the third camera added to it
  LandmarkView view;                 ///< edges that led to the verdict; empty without two usable images
  std::optional<LeafSight> leaf;     ///< leaf of the door found; nullopt: no door was found
  std::optional<StereoDrift> drift;  ///< turn of the right camera; nullopt: this look does not determine it
  Scene scene;                       ///< what else stands there
};

/// Settings of a look's evaluation.
struct LookOptions {
  EdgeOperator::Options edges;
  LandmarkFixOptions finder;
  LeafOptions leaf;
  StereoDriftOptions drift;
  SceneOptions scene;
  FarEdgeOptions far;
  FarSightOptions far_sight;
};

/// Evaluates looks: edges of all images, undistorted once, then the landmark, a door's leaf, its view and
/// the drift from the same views. Of earlier looks it keeps its buffers, and what they showed of each
/// landmark.
class LookEvaluator {
 public:
  LookEvaluator(const HeadModel& head, const LookOptions& options);

  /// Evaluates one look. The verdict of an incomplete input is kNoModel, kNoPose or kNoImage (an image lost,
  /// smaller than 64x64 px, or taken at a setting outside of the calibration), in this order.
  LookResult Evaluate(const LookInput& input);
  /// Evaluates a look at what earlier looks showed beyond the landmark. Its fix tells the direction of the
  /// landmark, and next to nothing of its place (SeeFar).
  LandmarkFix SeeBeyond(const LookInput& input);
  /// What looks showed beyond a landmark.
  const FarEdges& Beyond(int landmark_id) {
    return far_.try_emplace(landmark_id, far_options_).first->second;
  }

 private:
  std::optional<StereoViews> ViewsOf(const LookInput& input, std::array<CameraModel, 2>& cameras);
  std::optional<CameraModel> ThirdCamera(const LookInput& input);

  HeadModel head_;
  LeafOptions leaf_options_;
  StereoDriftOptions drift_options_;
  SceneOptions scene_options_;
  FarEdgeOptions far_options_;
  FarSightOptions far_sight_;
  EdgeOperator edge_operator_;
  LandmarkFinder finder_;
  std::array<EdgeImage, kCameras> edges_;
  std::map<int, LandmarkMemory> known_;  ///< by the landmark's id
  std::map<int, FarEdges> far_;          ///< by the landmark's id, too
};

}  // namespace priamos::head
