#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/image_size.hpp"
#include "common/outcome.hpp"

namespace priamos::head {

/// Parameters of a lens at one zoom and focus.
struct LensState {
  double focal_px = 1000;
  /// Principal point, which moves with the lens groups.
  Eigen::Vector2d centre_px = ImageSize{}.Centre();
  double k1 = 0, k2 = 0;  ///< radial distortion at one focal length from the centre, see CameraModel
  double pupil_m = 0;     ///< centre of projection before the camera's mounting point
};

/// A lens calibrated at the nodes of a grid over zoom and focus steps.
///
/// Between the nodes cubic polynomials through the four nearest ones in each direction (fewer where there
/// are fewer) carry the parameters, the focal length by its logarithm. The nodes keep their values.
class LensTable {
 public:
  LensTable() = default;
  /// Table over zoom and focus [motor steps]; `nodes[i * focus_steps.size() + j]` belongs to zoom_steps[i],
  /// focus_steps[j]; both ascending. Throws std::invalid_argument for sizes or orders that do not fit.
  LensTable(std::vector<int> zoom_steps, std::vector<int> focus_steps, std::vector<LensState> nodes);

  /// The lens at a setting. Refuses one outside the calibrated interval. A direction
  /// with a single node accepts only that.
  Outcome<LensState> At(double zoom_step, double focus_step) const;

  const std::vector<int>& zoom_steps() const { return zoom_steps_; }
  const std::vector<int>& focus_steps() const { return focus_steps_; }
  const std::vector<LensState>& nodes() const { return nodes_; }

 private:
  std::vector<int> zoom_steps_, focus_steps_;
  std::vector<LensState> nodes_;
};

}  // namespace priamos::head
