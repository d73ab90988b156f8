#include "planner/core/map/wall_faces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/cross.hpp"

namespace priamos::planner {
namespace {

constexpr double kDoorway_m = 1.5;  ///< the widest gap that does not part a wall
constexpr double kOnLine_m = 0.01;  ///< pieces of one wall lie on one line
constexpr double kSameAngle_rad = 0.004;
constexpr double kReach_m = 5;          ///< a face farther beside the way is not heard
constexpr double kSample_m = 0.25;      ///< between two places of the way
constexpr double kLeastAlong_m = 0.75;  ///< a face that is beside less of the way tells little

/// `a` and, behind it, `b` as one face; nullopt when they are not of one wall.
std::optional<WallFace> Joined(const WallFace& a, const WallFace& b) {
  const Eigen::Vector2d along = a.along();
  const double gap_m = along.dot(b.from - a.to);
  if (std::abs(Cross(along, b.along())) > kSameAngle_rad || along.dot(b.along()) < 0) return std::nullopt;
  if (gap_m < -kOnLine_m || gap_m > kDoorway_m) return std::nullopt;
  if (std::abs(Cross(along, b.from - a.to)) > kOnLine_m) return std::nullopt;
  return WallFace{a.from, b.to, std::max(a.sigma_m, b.sigma_m)};
}

/// Joins two of the faces; false when none are of one wall.
bool JoinTwo(std::vector<WallFace>& faces) {
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t k = 0; k < faces.size(); ++k) {
      if (i == k) continue;
      const auto joined = Joined(faces[i], faces[k]);
      if (!joined) continue;
      faces[i] = *joined;
      faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(k));
      return true;
    }
  return false;
}

/// Distance at which a ray meets a face from its front; nullopt: it does not.
std::optional<double> Meets(const WallFace& face, const Eigen::Vector2d& from, const Eigen::Vector2d& ray) {
  const Eigen::Vector2d along = face.along();
  const double towards = -Cross(along, ray);  // the face is to the right of its direction
  if (towards < 1e-6) return std::nullopt;
  const double distance_m = -Cross(along, face.from - from) / towards;
  const double at_m = along.dot(from + distance_m * ray - face.from);
  if (distance_m < 0 || at_m < 0 || at_m > face.length_m()) return std::nullopt;
  return distance_m;
}

std::optional<std::pair<std::size_t, double>> NearestIn(const std::vector<WallFace>& faces,
                                                        const Eigen::Vector2d& from,
                                                        const Eigen::Vector2d& ray) {
  std::optional<std::pair<std::size_t, double>> nearest;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const auto distance_m = Meets(faces[i], from, ray);
    if (distance_m && (!nearest || *distance_m < nearest->second)) nearest = {i, *distance_m};
  }
  return nearest;
}

}  // namespace

std::vector<WallFace> FacesOf(const GroundPlan& plan) {
  std::vector<WallFace> faces;
  for (const WallPlan& wall : plan.walls) {
    if ((wall.to() - wall.from()).norm() < kOnLine_m) continue;
    const Eigen::Vector2d along = (wall.to() - wall.from()).normalized();
    const Eigen::Vector2d left = Eigen::Vector2d(-along.y(), along.x()) * (wall.thickness_m / 2);
    faces.push_back({wall.from() + left, wall.to() + left});
    faces.push_back({wall.to() - left, wall.from() - left});
  }
  while (JoinTwo(faces)) {
  }
  return faces;
}

std::vector<WallFace> FacesAlong(const std::vector<WallFace>& faces,
                                 const std::vector<Eigen::Vector2d>& way) {
  std::vector<std::pair<double, std::size_t>> beside;
  for (std::size_t i = 0; i < faces.size(); ++i) beside.emplace_back(0, i);
  for (std::size_t k = 1; k < way.size(); ++k) {
    const double length_m = (way[k] - way[k - 1]).norm();
    const Eigen::Vector2d ahead =
        length_m > 0 ? Eigen::Vector2d((way[k] - way[k - 1]) / length_m) : Eigen::Vector2d(1, 0);
    const Eigen::Vector2d left(-ahead.y(), ahead.x());
    for (double at_m = 0; at_m <= length_m; at_m += kSample_m)
      for (const double side : {1.0, -1.0}) {
        const auto nearest = NearestIn(faces, way[k - 1] + at_m * ahead, side * left);
        if (nearest && nearest->second < kReach_m) beside[nearest->first].first += kSample_m;
      }
  }
  std::stable_sort(beside.begin(), beside.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<WallFace> along;
  for (const auto& [length_m, index] : beside)
    if (length_m >= kLeastAlong_m && along.size() < kMostFaces) along.push_back(faces[index]);
  return along;
}

std::optional<double> DistanceAhead(const std::vector<WallFace>& faces, const Eigen::Vector2d& from,
                                    const Eigen::Vector2d& direction) {
  const auto nearest = NearestIn(faces, from, direction);
  return nearest ? std::optional(nearest->second) : std::nullopt;
}

}  // namespace priamos::planner
