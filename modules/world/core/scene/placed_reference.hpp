#pragma once

#include <Eigen/Geometry>

#include "common/reference_object.hpp"

namespace priamos::world {

/// The calibration body, and where it stands.
struct PlacedReference {
  ReferenceObject object;
  Eigen::Isometry3d map_from_object = Eigen::Isometry3d::Identity();
};

}  // namespace priamos::world
