#pragma once

#include <vector>

#include "common/random.hpp"
#include "common/reference_object.hpp"
#include "head/core/calibration/rig/head_solver.hpp"
#include "head/core/camera/head_model.hpp"

namespace priamos::support {

/// A KASTOR head with manufacturing errors, gears with play, and zoom lenses whose every parameter wanders
/// with zoom and focus: what calibration does not know.
class SimulatedHead {
 public:
  using HeadSetting = head::HeadSetting;
  struct Motors {
    double play_rad = 0.0004, repeatability_rad = 0.00003;
    double play_steps = 6, repeatability_steps = 0.4;
  };

  explicit SimulatedHead(std::uint64_t seed) : SimulatedHead(seed, Motors()) {}
  SimulatedHead(std::uint64_t seed, const Motors& motors);

  /// Turns the motors to a setting; the axes stop on the side they came from.
  void MoveTo(const HeadSetting& setting);
  /// Moves to a setting from below, as calibration prescribes.
  void ApproachFromBelow(const HeadSetting& setting);

  const HeadSetting& counters() const { return counters_; }
  const head::HeadGeometry& geometry() const { return geometry_; }
  /// The camera as it is now.
  head::CameraModel Now(int camera) const;
  /// The camera as it is on average after an approach from below.
  head::CameraModel AfterApproach(const HeadSetting& setting, int camera) const;

 private:
  /// Where the axes are: zoom and focus need not be whole steps.
  struct Axes {
    HeadSetting angles;
    std::array<double, 2> zoom{}, focus{};
  };
  head::CameraModel CameraAt(const Axes& axes, int camera) const;
  head::LensState LensAt(int camera, double zoom, double focus) const;

  Motors motors_;
  Rng rng_;
  head::HeadGeometry geometry_;
  std::array<std::array<double, 8>, 3> lens_variation_;
  HeadSetting counters_;
  Axes axes_;
};

/// What the cameras see of the object (given in the base frame) in one exposure, with a detector's noise.
/// Discs outside of the image are left out, and so is a camera that sees fewer than 10.
std::vector<head::HeadView> Observe(const SimulatedHead& simulated, const ReferenceObject& in_base,
                                    int exposure, double noise_px, Rng& rng);

/// The shipped object in front of the head, `distance_m` before its pan axis.
Eigen::Isometry3d ObjectBeforeHead(double distance_m);

}  // namespace priamos::support
