#pragma once

#include <array>
#include <span>

#include "head/core/doors/opening_surfaces.hpp"

namespace priamos::head {

/// Whether a door lets somebody through.
enum class DoorState { kUnknown = 0, kClosed = 1, kAjar = 2, kOpen = 3 };

/// What one stereo pair, or several together, show of a door's leaf.
struct DoorStateEvidence {
  /// Log likelihood of closed, ajar and open, up to a common summand.
  std::array<double, 3> log_likelihood{};

  void operator+=(const DoorStateEvidence& other);
  /// The likeliest one, if it leads by `min_lead`.
  DoorState State(double min_lead) const;
  /// Its lead over the next best one.
  double Lead() const;
};

/// How leaves stand in doors, and what a piece of surface is worth.
struct DoorStateOptions {
  double ajar_rad = Radians(4), open_rad = Radians(30);  ///< between them a door is ajar
  double deepest_m = 0.25;      ///< of a closed leaf behind the uprights; the thickest wall
  double foremost_m = 0.05;     ///< of one that opens towards the robot, before them
  double leaf_sigma_m = 0.012;  ///< of a piece of surface from the plane of its leaf
  double each = 0.25;           ///< how much of its likelihood counts: neighbouring pieces err together
  double most = 6;              ///< log likelihood of all together, at most
};

/// The state of a door by the surfaces in its opening: pieces of one upright plane across it are a leaf, at
/// the angle at which that plane stands to the wall; what is seen behind that plane speaks against it. A leaf
/// that stands wide open shows itself by leaving the view free.
DoorStateEvidence StateOf(const OpeningShape& opening, std::span<const SurfacePoint> surfaces,
                          const DoorStateOptions& options = {});

}  // namespace priamos::head
