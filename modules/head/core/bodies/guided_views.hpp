#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "head/core/edges/guided_edges.hpp"
#include "head/core/edges/step_meter.hpp"
#include "head/core/landmark/landmark.hpp"
#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// Views whose images were measured once more along the edges that a pose predicts, so that edges which the
/// operator lost take part. Lines of the operator that the new ones repeat are left out. Refers to itself.
class GuidedViews {
 public:
  /// Measures the images of `views` with `guides`, one for each, along the edges `seen` of a body at
  /// `base_from_model`; with `meters`, one for each or none, what those lose in blurred images.
  GuidedViews(const LandmarkModel& seen, const Eigen::Isometry3d& base_from_model,
              std::span<const CameraView> views, std::span<GuidedEdges> guides,
              std::span<const StepMeter> meters = {});
  GuidedViews(const GuidedViews&) = delete;
  GuidedViews& operator=(const GuidedViews&) = delete;

  std::span<const CameraView> views() const { return views_; }

 private:
  std::vector<EdgeImage> edges_;
  std::vector<CameraView> views_;
};

}  // namespace priamos::head
