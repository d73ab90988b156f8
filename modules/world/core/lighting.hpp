#pragma once

#include <Eigen/Core>
#include <vector>

#include "world/core/scene.hpp"
#include "world/core/solid.hpp"

namespace priamos::world {

/// The solids and the light in them, for rays: how bright a surface is, how far the next thing is.
class Lighting {
 public:
  Lighting(const SceneConfig& config, const std::vector<Solid>& solids);

  /// Light on a surface element: about 1 under a lamp, 0 in the dark. Lamps are hidden by solids, corners get
  /// less of the ambient light; light is not reflected from surface to surface.
  double At(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;

  /// Distance to the first solid, floor or ceiling along a unit vector; `max_m` if there is none before.
  double Distance(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double max_m) const;

 private:
  struct Box {
    double c, s;  ///< of its yaw
    Eigen::Vector3d centre, half;
  };
  double Ambient(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;
  double Lamps(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;
  double Hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double max_m) const;

  SceneConfig config_;
  std::vector<Box> boxes_;
  std::vector<Eigen::Vector3d> lamps_;
  Eigen::Vector3d window_;
};

}  // namespace priamos::world
