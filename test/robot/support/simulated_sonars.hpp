#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "common/geometry.hpp"
#include "common/random.hpp"
#include "robot/core/sonar/echo_memory.hpp"

namespace priamos::robot {

/// A straight piece of surface, map frame.
struct Surface {
  Eigen::Vector2d from, to;
};

/// The four sides of an upright box.
std::vector<Surface> BoxSides(double x_min, double y_min, double x_max, double y_max);

/// The ring of 24 before a few surfaces: first echo within the cone, lost when it meets a smooth surface too
/// obliquely unless an edge is in the cone, never below 0.1 m; now and then a false echo.
class SimulatedSonars {
 public:
  SimulatedSonars(std::uint64_t seed, std::vector<Surface> surfaces)
      : rng_(Rng::Stream(seed, "simulated sonars")), surfaces_(std::move(surfaces)) {}

  void Clear() { surfaces_.clear(); }
  void SetFalseEchoes(double chance_per_sensor) { false_echoes_ = chance_per_sensor; }
  void Add(const std::vector<Surface>& surfaces) {
    surfaces_.insert(surfaces_.end(), surfaces.begin(), surfaces.end());
  }
  /// Sensors i, i + groups, ... fire together from now on: the last of them where a cycle ends, the others on
  /// the way there from where the cycle before ended.
  void FireInGroups(int groups) { groups_ = groups; }
  SonarCycle Listen(Time time, const Pose2& map_from_base);

  /// Distance from the true footprint to the nearest surface; negative when one is inside.
  double Gap(const Pose2& map_from_base) const;

 private:
  double FirstEcho(const Pose2& map_from_sonar);

  Rng rng_;
  std::vector<Surface> surfaces_;
  double false_echoes_ = 0;
  int groups_ = 1;
  std::optional<Pose2> before_;  ///< where the cycle before ended
};

}  // namespace priamos::robot
