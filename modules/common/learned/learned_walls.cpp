#include "common/learned/learned_walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>

#include "common/config.hpp"
#include "common/config_printer.hpp"
#include "common/learned/required_place.hpp"
#include "common/replace_file.hpp"

namespace priamos {
namespace {

constexpr int kMostWalls = 100000;
constexpr unsigned kMode = 0644;

/// `what`: one of them in a word.
template <class T>
void RefuseTwice(Archive& a, std::string_view key, const std::vector<T>& all, std::string_view what) {
  std::set<int> ids;
  for (const T& one : all)
    if (!ids.insert(one.id).second)
      a.Refuse(key, fmt::format("every {} with its own id, not {} twice", what, one.id));
}

}  // namespace

void LearnedWall::Describe(Archive& a) {
  a.Integer("id", id, {"-", 1, 1e9, "number of the wall"});
  a.Number("x_m", x_m, {"m", -200, 200, "map, its middle"});
  a.Number("y_m", y_m, {"m", -200, 200, "map, its middle"});
  a.Number("yaw_deg", yaw_deg, {"deg", -180, 180, "map, its direction; the robot was to the left"});
  a.Number("length_m", length_m, {"m", 0, 200, "length"});
  a.Number("sigma_across_m", sigma_across_m, {"m", 0, 100, "standard deviation of its middle, across it"});
  a.Number("sigma_yaw_deg", sigma_yaw_deg, {"deg", 0, 180, "standard deviation of its direction"});
  a.Number("rho", rho, {"-", -1, 1, "correlation of middle and direction"});
  a.Number("sigma_end_m", sigma_end_m, {"m", 0, 100, "standard deviation of both ends, along it"});
  a.Number("seen_s", seen_s, {"s", 0, 1e11, "since 1970, when it was heard last"});
  a.Integer("sightings", sightings, {"-", 1, 1e9, "how often a robot told of it"});
  RequirePlace(a, "the number of the wall");
}

Eigen::Matrix2d LearnedWall::covariance() const {
  const double yaw = Radians(sigma_yaw_deg), both = rho * sigma_across_m * yaw;
  return (Eigen::Matrix2d() << sigma_across_m * sigma_across_m, both, both, yaw * yaw).finished();
}

void LearnedWall::SetCovariance(const Eigen::Matrix2d& covariance) {
  const double across = std::sqrt(std::max(0.0, covariance(0, 0))),
               yaw = std::sqrt(std::max(0.0, covariance(1, 1)));
  sigma_across_m = across;
  sigma_yaw_deg = Degrees(yaw);
  rho = across * yaw > 0 ? std::clamp(covariance(0, 1) / (across * yaw), -1.0, 1.0) : 0;
}

double LearnedWall::SigmaAt(double along_m) const {
  const Eigen::Vector2d by_wall(1, along_m);
  return std::sqrt(std::max(0.0, by_wall.dot(covariance() * by_wall)));
}

void LearnedWalls::Describe(Archive& a) {
  a.Integer("version", version, {"-", kVersion, kVersion, "of this file's form"});
  a.Require("version", fmt::format("{}, the version of the file's form", kVersion));
  a.Integer("revision", revision, {"-", 0, 2e9, "counts the changes"});
  a.List("walls", walls, "straight pieces of wall");
  RefuseTwice(a, "walls", walls, "wall");
  a.List("doors", doors, "doors that were seen");
  RefuseTwice(a, "doors", doors, "door");
  a.List("objects", objects, "things that stand on the floor");
  RefuseTwice(a, "objects", objects, "thing");
  a.List("points", points, "places that echo to all sides");
  RefuseTwice(a, "points", points, "point");
  if (points.size() > kMostPoints) a.Refuse("points", "at most 1000 of them");
  if (objects.size() > kMostObjects) a.Refuse("objects", "at most 300 of them");
  if (doors.size() > static_cast<std::size_t>(kMostWalls)) a.Refuse("doors", "at most 100000 of them");
  if (walls.size() > static_cast<std::size_t>(kMostWalls)) a.Refuse("walls", "at most 100000 of them");
}

LearnedWalls LoadLearnedWalls(const std::string& path) {
  if (!std::filesystem::exists(path)) return {};
  return LoadConfig<LearnedWalls>(path);
}

bool SaveLearnedWalls(const std::string& path, const LearnedWalls& walls) {
  std::ostringstream text;
  text << "# What the planner has learned of the building. `priamos map` shows it, `priamos map reset` "
          "forgets it.\n";
  PrintConfig(text, walls);
  return ReplaceFile(path, text.str(), true, kMode);
}

}  // namespace priamos
