#include "planner/core/explore/kept_walls.hpp"

#include <algorithm>
#include <cmath>

namespace priamos::planner {
namespace {

/// Left for so long a wall is as the first visit shows it.
constexpr double kLeft_s = 4;
/// A shorter wall, or one known worse, tells too little about the pose.
constexpr double kLeast_m = 1.0, kMostSigma_m = 0.08, kLeastSigma_m = 0.01;
/// Walls that face the same way, so near to each other and beside each other are one.
constexpr double kSameFacing_rad = Radians(15), kSame_m = 0.4;

}  // namespace

void KeptWalls::Learn(const LearnedWalls& walls, double now_s) {
  for (const LearnedWall& wall : walls.walls) {
    const double sigma_m = std::max(wall.SigmaAt(-wall.length_m / 2), wall.SigmaAt(wall.length_m / 2));
    if (now_s - wall.seen_s < kLeft_s || wall.length_m < kLeast_m || sigma_m > kMostSigma_m) continue;
    const WallFace face{wall.from(), wall.to(), std::max(sigma_m, kLeastSigma_m)};
    if (!kept_.contains(wall.id) && !Has(face)) kept_[wall.id] = face;
  }
}

bool KeptWalls::Has(const WallFace& face) const {
  return std::any_of(kept_.begin(), kept_.end(), [&](const auto& kept) {
    const WallFace& other = kept.second;
    const Eigen::Vector2d along = other.along(), middle = (face.from + face.to) / 2 - other.from;
    const bool parallel = along.dot(face.along()) > std::cos(kSameFacing_rad);
    const double across_m = std::abs(along.x() * middle.y() - along.y() * middle.x());
    const double from_m = along.dot(face.from - other.from), to_m = along.dot(face.to - other.from);
    return parallel && across_m < kSame_m && std::max(from_m, to_m) > 0 &&
           std::min(from_m, to_m) < other.length_m();
  });
}

std::vector<WallFace> KeptWalls::Faces() const {
  std::vector<WallFace> faces;
  for (const auto& [id, face] : kept_) faces.push_back(face);
  return faces;
}

}  // namespace priamos::planner
