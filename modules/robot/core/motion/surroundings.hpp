#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/time.hpp"
#include "robot/core/motion/drive_config.hpp"
#include "robot/core/sonar/approach_watch.hpp"
#include "robot/core/sonar/echo_memory.hpp"
#include "robot/core/sonar/floor_memory.hpp"
#include "robot/core/sonar/hanging_memory.hpp"
#include "robot/core/sonar/mover_watch.hpp"

namespace priamos::robot {

/// The obstacles that limit a motion, base frame [m].
struct Obstacles {
  std::vector<Eigen::Vector2d> seen, remembered;
  /// Of `seen`, places that are known well enough to plan with from afar: before who comes, and on the
  /// floor, and hanging.
  std::vector<Eigen::Vector2d> placed{};
};

/// What is around the base, by everything that sees it: echoes of the sonars and the evidence that they
/// leave, who moves among it, lines of the laser on the floor, and what the head saw hanging.
class Surroundings {
 public:
  explicit Surroundings(const DriveConfig& config);

  /// Changes which echoes are believed.
  void Believe(const EchoMemoryConfig& config) { echoes_.Believe(config); }
  /// Takes a cycle of the sonars. `odom_from_base`: pose when the cycle ended; `heeds_movers`: what moves is
  /// no evidence of what stays.
  void AddSonar(const SonarCycle& cycle, const Pose2& odom_from_base, bool heeds_movers);
  /// Takes a line of the laser; returns false when FloorMemory refused it. `odom_from_base`: pose when the
  /// picture was taken.
  bool AddFloorLine(const FloorLine& line, const Pose2& odom_from_base, Time now) {
    return floor_.Add(line, odom_from_base, now);
  }
  /// Takes a thing that the head saw. `odom_from_map`: as it is known now.
  void AddSeenThing(const SeenThing& thing, const Pose2& odom_from_map) {
    hanging_.Take(thing, odom_from_map);
  }
  /// Forgets what is far, old or out of use. `driving`: a path is being driven.
  void Forget(const Pose2& odom_from_base, Time now, bool driving);

  /// What is to limit a motion. `bridges`: gaps too narrow for the base are closed; `heeds_movers`: so is the
  /// floor before who comes.
  Obstacles Around(const Pose2& odom_from_base, bool bridges, bool heeds_movers) const;
  /// What a path is to be led around, base frame [m]. What stops the base is among it also before there is
  /// evidence.
  std::vector<Eigen::Vector2d> ToLeadAround(const Obstacles& around, const Pose2& odom_from_base,
                                            Time now) const;
  /// Whether a base of this velocity [m/s, base frame] and somebody who moves meet within that time.
  bool IsAboutToMeet(const Pose2& odom_from_base, const Eigen::Vector2d& velocity, double within_s) const;

  const MoverWatch& movers() const { return movers_; }
  const ApproachWatch& approach() const { return approach_; }
  /// When the newest cycle of the sonars ended.
  std::optional<Time> heard() const { return echoes_.newest(); }

 private:
  Footprint footprint_;
  EchoMemory echoes_;
  FloorMemory floor_;
  HangingMemory hanging_;
  MoverWatch movers_;
  ApproachWatch approach_;
};

}  // namespace priamos::robot
