#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "common/archive.hpp"

namespace priamos {

/// One retro-reflective disc of the reference object.
struct ReferenceDisc {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< unit, out of the visible side
  double radius_m = 0.02;

  void Describe(Archive& a);
};

/// One black, axis-parallel solid that carries discs and may hide others.
struct ReferenceBlock {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d size_m = Eigen::Vector3d::Constant(0.1);

  void Describe(Archive& a);
};

/// The calibration object of figure 3 of the paper as data: any object with at least 6 discs works. The
/// frame is the object's own until Moved puts it into another one.
struct ReferenceObject {
  std::string name;
  std::vector<ReferenceDisc> discs;
  std::vector<ReferenceBlock> blocks;

  /// Describes the keys of the object's file to LoadConfig; refuses fewer than 6 discs and two discs in one
  /// place.
  void Describe(Archive& a);

  /// The discs in frame a; the blocks stay behind, they only describe the body in its own frame.
  ReferenceObject Moved(const Eigen::Isometry3d& a_from_object) const;
};

}  // namespace priamos
