#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "common/config.hpp"

namespace priamos::world {

/// One retro-reflective disc of the calibration body.
struct ReferenceDisc {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< out of the visible side
  double radius_m = 0.02;

  void Describe(Archive& a);
};

/// One black block of its body.
struct ReferenceBlock {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d size_m = Eigen::Vector3d::Constant(0.1);

  void Describe(Archive& a);
};

/// The reference object of figures 3 and 4 of the paper, as config/sim/reference_object.toml gives it: frame
/// with x out of the front towards the viewer, z up.
struct ReferenceObject {
  std::string name;
  std::vector<ReferenceDisc> discs;
  std::vector<ReferenceBlock> blocks;

  void Describe(Archive& a);
};

/// Where it stands.
struct PlacedReference {
  ReferenceObject object;
  Eigen::Isometry3d map_from_object = Eigen::Isometry3d::Identity();
};

}  // namespace priamos::world
