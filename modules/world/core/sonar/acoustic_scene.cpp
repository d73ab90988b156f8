#include "world/core/sonar/acoustic_scene.hpp"

#include <algorithm>

namespace priamos::world {
namespace {

/// Edges nearer than this to another solid are joints, not edges (a wave length).
constexpr double kJoint_m = 0.007;

}  // namespace

void EchoMaterial::Describe(Archive& a) {
  a.Text("material", material, "name of the material in the list of solids");
  a.Number("specular_limit_deg", specular_limit_deg, {"deg", 0.5, 90, "a mirror up to this incidence"});
  a.Number("diffuse_db", diffuse_db, {"dB", -200, 0, "echo from any incidence, 0 is a mirror"});
  a.Number("reflection_loss_db", reflection_loss_db, {"dB", 0, 100, "lost when the sound bounces on"});
}

std::vector<EchoMaterial> EchoMaterial::Defaults() {
  return {{"plaster", 12, -50, 1},    {"concrete", 12, -38, 1},  {"wood", 10, -48, 1},
          {"door_frame", 10, -60, 1}, {"door_leaf", 10, -55, 1}, {"furniture", 10, -48, 1},
          {"cupboard", 10, -48, 1},   {"metal", 10, -60, 1},     {"cardboard", 14, -32, 3},
          {"poster", 10, -55, 2},     {"glass", 10, -60, 1},     {"mirror", 10, -60, 1},
          {"carpet", 20, -22, 12},    {"fabric", 20, -18, 15}};
}

AcousticScene::AcousticScene(const std::vector<Solid>& solids, double height_m, double half_band_m,
                             const std::vector<EchoMaterial>& materials)
    : materials_(std::make_shared<const std::vector<EchoMaterial>>(
          materials.empty() ? std::vector<EchoMaterial>(1) : materials)) {
  for (std::size_t i = 0; i < solids.size(); ++i) {
    const Solid& solid = solids[i];
    if (!Overlaps(solid, height_m - half_band_m, height_m + half_band_m)) continue;
    const auto known = std::find_if(materials_->begin(), materials_->end(),
                                    [&](const EchoMaterial& m) { return m.material == solid.material; });
    const auto index = known == materials_->end() ? 0 : static_cast<std::size_t>(known - materials_->begin());
    const Rectangle outline = OutlineOf(solid);
    obstacles_.push_back({outline, RayTarget(outline), index, i});
  }
  for (const auto& obstacle : obstacles_) FindEdges(obstacle);
}

void AcousticScene::FindEdges(const Obstacle& obstacle) {
  for (const auto& corner : obstacle.outline.Corners()) {
    const bool covered = std::any_of(obstacles_.begin(), obstacles_.end(), [&](const Obstacle& other) {
      return &other != &obstacle && Distance(other.outline, corner) < kJoint_m;
    });
    if (!covered) edges_.push_back({corner, obstacle.solid});
  }
}

AcousticScene AcousticScene::Around(const Eigen::Vector2d& place, double reach_m) const {
  AcousticScene around;
  around.materials_ = materials_;
  for (const Obstacle& obstacle : obstacles_)
    if ((obstacle.target.centre - place).norm() <= reach_m + obstacle.target.half.norm())
      around.obstacles_.push_back(obstacle);
  for (const AcousticEdge& edge : edges_)
    if ((edge.point - place).norm() <= reach_m) around.edges_.push_back(edge);
  return around;
}

void AcousticScene::Move(const MovedSolid& moved) {
  const auto it = std::find_if(obstacles_.begin(), obstacles_.end(),
                               [&](const Obstacle& obstacle) { return obstacle.solid == moved.solid; });
  if (it == obstacles_.end()) return;  // at another height
  it->outline.map_from_centre = moved.map_from_solid;
  it->target = RayTarget(it->outline);
  std::erase_if(edges_, [&](const AcousticEdge& edge) { return edge.solid == moved.solid; });
  FindEdges(*it);
}

std::optional<AcousticScene::Hit> AcousticScene::Nearest(const Eigen::Vector2d& origin,
                                                         const Eigen::Vector2d& direction,
                                                         double max_m) const {
  std::optional<Hit> nearest;
  for (const auto& obstacle : obstacles_) {
    const double limit = nearest ? nearest->distance_m : max_m;
    const auto hit = CastRay(obstacle.target, origin, direction, limit);
    if (hit)
      nearest = Hit{hit->distance_m, origin + direction * hit->distance_m, hit->normal,
                    &(*materials_)[obstacle.material]};
  }
  return nearest;
}

bool AcousticScene::Visible(const Eigen::Vector2d& from, const Eigen::Vector2d& point) const {
  const Eigen::Vector2d delta = point - from;
  const double distance = delta.norm();
  return distance > kJoint_m && !Nearest(from, delta / distance, distance - kJoint_m);
}

}  // namespace priamos::world
