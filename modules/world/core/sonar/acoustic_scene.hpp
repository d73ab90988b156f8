#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/archive.hpp"
#include "world/core/scene/moved_solid.hpp"
#include "world/core/scene/outline.hpp"
#include "world/core/scene/solid.hpp"

namespace priamos::world {

/// How a material answers 50 kHz sound (wave length 7 mm).
struct EchoMaterial {
  std::string material = "wall";   ///< name in Solid::material
  double specular_limit_deg = 10;  ///< a mirror up to this incidence
  double diffuse_db = -60;         ///< echo from any incidence, against a mirror at incidence 0
  double reflection_loss_db = 1;   ///< lost when the sound bounces on

  void Describe(Archive& a);
  /// Smooth plaster and lacquer are mirrors; cloth and wood chip echo from everywhere.
  static std::vector<EchoMaterial> Defaults();
};

/// A vertical edge of a solid that sound can reach.
struct AcousticEdge {
  Eigen::Vector2d point;
  std::size_t solid = 0;  ///< whose it is: its place in the list of solids
};

/// The solids as sound at one height meets them.
class AcousticScene {
 public:
  /// Keeps the solids within `height_m` +- `half_band_m`. A material that `materials` does not list answers
  /// like the first one listed.
  AcousticScene(const std::vector<Solid>& solids, double height_m, double half_band_m,
                const std::vector<EchoMaterial>& materials);

  /// Where a ray meets a solid first, map frame [m]; `normal` is the solid's outward unit normal.
  struct Hit {
    double distance_m;
    Eigen::Vector2d point, normal;
    const EchoMaterial* material;
  };
  std::optional<Hit> Nearest(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                             double max_m) const;
  /// Convex edges that no other solid covers.
  const std::vector<AcousticEdge>& edges() const { return edges_; }
  bool Visible(const Eigen::Vector2d& from, const Eigen::Vector2d& point) const;
  /// What lies within `reach_m` of a place, map frame: a world from a map of a building has thousands of
  /// solids, of which a ping can reach a few dozen. Edges keep their cover by solids farther away.
  AcousticScene Around(const Eigen::Vector2d& place, double reach_m) const;
  /// A solid is elsewhere now. Which edges of others it covers stays as it was.
  void Move(const MovedSolid& moved);

 private:
  struct Obstacle {
    Rectangle outline;
    RayTarget target;
    std::size_t material;
    std::size_t solid;
  };
  void FindEdges(const Obstacle& obstacle);

  AcousticScene() = default;

  std::shared_ptr<const std::vector<EchoMaterial>> materials_;  ///< at least one
  std::vector<Obstacle> obstacles_;
  std::vector<AcousticEdge> edges_;
};

}  // namespace priamos::world
