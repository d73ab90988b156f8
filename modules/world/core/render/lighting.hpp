#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "world/core/render/plan_index.hpp"
#include "world/core/scene/scene.hpp"
#include "world/core/scene/solid.hpp"

namespace priamos::world {

/// What a ray met that is no solid; holes are counted down from kFirstHole.
inline constexpr int kFloor = -1, kCeiling = -2, kNothing = -3, kFirstHole = -4;

/// What a ray meets first.
struct RayHit {
  double distance_m = 0;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< normal of the surface, towards the ray's origin
  int solid = kFloor;                                 ///< place in the list of solids, or what else it met
  bool mirror = false;                                ///< what hits it goes elsewhere
};

/// The solids and the light in them, for rays: how bright a surface is, how far the next thing is. Glass is
/// no obstacle to light.
class Lighting {
 public:
  Lighting(const SceneConfig& config, const std::vector<Solid>& solids);

  /// Light on a surface element: about 1 under a lamp, 0 in the dark. Lamps are hidden by solids, corners get
  /// less of the ambient light; light is not reflected from surface to surface.
  double At(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;

  /// The first solid, floor or ceiling along a unit vector; distance `max_m` if there is none before.
  RayHit Trace(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double max_m) const;
  double Distance(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double max_m) const;

 private:
  struct Box {
    double c, s;  ///< cosine and sine of its yaw
    Eigen::Vector3d centre, half;
    int solid;
    bool mirror;
  };
  double Ambient(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;
  double Lamps(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;
  /// Entry distance into one box, with the axis (0, 1, 2) of the face; negative if the ray misses it.
  double Enter(const Box& box, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
               int& axis) const;
  /// Floor or hole, which a ray meets unless a solid is before it.
  std::optional<FloorHit> Floor(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;
  /// Those that a ray of `reach_m` from `point` can meet: most rays are short, and most boxes far away.
  using Boxes = std::vector<const Box*>;
  Boxes Within(const Eigen::Vector3d& point, double reach_m) const;
  double Hit(const Boxes& boxes, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
             double max_m) const;
  double Distance(const Boxes& boxes, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                  double max_m) const;

  SceneConfig config_;
  std::vector<Box> boxes_;
  PlanIndex index_;  ///< of boxes_
  std::vector<Eigen::Vector3d> lamps_;
  Eigen::Vector3d window_;
};

}  // namespace priamos::world
