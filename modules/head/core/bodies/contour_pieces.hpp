#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "head/core/camera/projection.hpp"
#include "head/core/edges/step_meter.hpp"
#include "head/core/landmark/landmark.hpp"
#include "head/core/stereo/view_line.hpp"

namespace priamos::head {

/// A short piece of a predicted edge in one image, with the step of brightness that was measured there.
struct ContourPiece {
  double along_px = 0, length_px = 0;  ///< its middle from the edge's beginning; its length
  Eigen::Vector2d at = Eigen::Vector2d::Zero(), normal = at;  ///< its middle and unit normal [distorted px]
  Step step;

  /// Whether there is a clear step of brightness at all, wherever beside the prediction.
  bool IsStep() const;
};

/// The predicted edges of one body in one image.
class ContourPieces {
 public:
  /// Projects `seen` at `base_from_model`. Keeps a reference to `view`.
  ContourPieces(const LandmarkModel& seen, const Eigen::Isometry3d& base_from_model, const CameraView& view);

  /// Of each edge of `seen`; nullopt where it is not in the image.
  std::span<const std::optional<ProjectedEdge>> edges() const { return edges_; }
  /// The pieces of an edge that is in the image of `meter`, `n_beyond` more at each end of it; those at the
  /// border of the image are left out.
  std::vector<ContourPiece> Measure(const StepMeter& meter, std::size_t edge, int n_beyond) const;

 private:
  std::vector<double> Beside(std::size_t edge, double along_px) const;

  const CameraView& view_;
  std::vector<std::optional<ProjectedEdge>> edges_;
};

/// Appends to `out` the edge that the pieces show beside the prediction, if most of them agree on one.
bool AppendLine(std::span<const ContourPiece> pieces, double length_px, double blur_px, EdgeImage& out);

}  // namespace priamos::head
