#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "common/config.hpp"

namespace priamos::world {

/// One retro-reflective disc of the calibration body.
struct ReferenceDisc {
  double x_m = 0, y_m = 0, z_m = 0;  ///< centre, in the frame of the object
  double normal_x = 1, normal_y = 0, normal_z = 0;
  double radius_m = 0.016;

  void Describe(Archive& a);
};

/// One dark block of its body.
struct ReferenceBlock {
  double x_min_m = 0, y_min_m = 0, z_min_m = 0, x_max_m = 0.03, y_max_m = 0, z_max_m = 0;

  void Describe(Archive& a);
};

/// The reference object of figures 3 and 4: a black body 60 cm wide, 50 cm high and 25 cm deep with 16
/// retro-reflective discs at four depths. Frame: origin in the middle of its back, x out of the front towards
/// the viewer, z up (so y is to the viewer's right).
struct ReferenceObject {
  std::vector<ReferenceDisc> discs = StandardDiscs();
  std::vector<ReferenceBlock> blocks = StandardBlocks();

  void Describe(Archive& a);
  static std::vector<ReferenceDisc> StandardDiscs();
  static std::vector<ReferenceBlock> StandardBlocks();
};

/// Where it stands.
struct PlacedReference {
  ReferenceObject object;
  Eigen::Isometry3d map_from_object = Eigen::Isometry3d::Identity();
};

}  // namespace priamos::world
