#pragma once

#include <Eigen/Core>
#include <map>
#include <utility>
#include <vector>

#include "common/archive.hpp"
#include "robot/core/sonar/sonar_cycle.hpp"

namespace priamos::bench {

/// How echoes become points for drivers that want points.
struct EchoCloudConfig {
  double reach_m = 2.5;     ///< echoes from farther away are left out: their arcs are wide
  double half_arc_deg = 5;  ///< part of the beam on which an echo is marked, to either side
  double through_deg = 5;   ///< part of the beam that shows that there is nothing before the echo
  double through_m = 0.15;  ///< nearer to the echo than this nothing is cleared
  double keep_s = 8;        ///< how long a mark counts that is neither renewed nor seen through
  double near_m = 0.3;      ///< an echo from nearer counts at once, others when a second one agrees

  void Describe(Archive& a);
};

/// Memory of echoes in the frame of the odometry: marked cells of 5 cm that a second echo has confirmed,
/// until a beam sees what is behind them or they are old.
class EchoCloud {
 public:
  explicit EchoCloud(const EchoCloudConfig& config) : config_(config) {}

  void Add(const robot::SonarCycle& cycle, const Pose2& odom_from_base, Time now);
  /// Centres of the cells that count, base frame of `odom_from_base` [m].
  std::vector<Eigen::Vector2d> Points(const Pose2& odom_from_base) const;

 private:
  struct Mark {
    int echoes = 0;
    Time newest{};
  };
  using Cell = std::pair<int, int>;
  void Clear(const Pose2& odom_from_sonar, double range_m);
  void Put(const Pose2& odom_from_sonar, double range_m, Time now);

  EchoCloudConfig config_;
  std::map<Cell, Mark> marks_;
};

}  // namespace priamos::bench
