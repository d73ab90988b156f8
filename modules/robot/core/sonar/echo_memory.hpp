#pragma once

#include <Eigen/Core>
#include <array>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "common/archive.hpp"
#include "common/geometry.hpp"
#include "common/sonar_ring.hpp"
#include "common/time.hpp"
#include "robot/core/base/footprint.hpp"
#include "robot/core/sonar/evidence_grid.hpp"
#include "robot/core/sonar/near_map.hpp"
#include "robot/core/sonar/sonar_cycle.hpp"

namespace priamos::robot {

/// How echoes become points in the base frame, and how long they count.
struct EchoMemoryConfig {
  double half_beam_deg = 7.5;  ///< an echo lies anywhere on this arc
  double agreement_m = 0.3;    ///< two echoes nearer than this to each other confirm one another
  double near_m = 0.25;        ///< an echo this near counts at once
  double blind_m = 0.12;       ///< echoes up to here may come from nearer: sensors do not measure below 0.1 m
  double blind_as_m = 0.05;    ///< where such an echo is taken to come from
  double keep_s = 0.22;        ///< how long an echo counts that nothing newer replaces: two cycles at 10 Hz
  double bridge_from_m = 0.5;  ///< range of neighbouring echoes up to which they may be one thing
  double bridge_m = 0.4;       ///< largest distance between the two echoes of one thing, see Bridges
  NearMapConfig near_map;
  EvidenceGridConfig evidence;

  void Describe(Archive& a);
};

/// Decides which echoes are believed, and where that puts things around the base. A single echo may be
/// another sensor's sound, and a real one may be lost on a smooth surface. So an echo counts when a second
/// one in the last three cycles, or a neighbour in the same cycle, agrees with it, or when it is very near;
/// and it counts until its sensor hears another one or its cycle is forgotten. Odometry moves remembered
/// echoes along.
class EchoMemory {
 public:
  EchoMemory(const EchoMemoryConfig& config, const Footprint& footprint);

  /// Changes how near an echo counts at once, and how long one counts.
  void Believe(const EchoMemoryConfig& config) {
    config_.near_m = config.near_m;
    config_.keep_s = config.keep_s;
  }
  /// Whether an echo, frame of the odometry, is of a thing that stays where it is.
  using Stays = std::function<bool(const Eigen::Vector2d&)>;
  /// Adds a cycle of the sonars. `odom_from_base`: pose at the end of the cycle. Of what does not stay there
  /// is no evidence.
  void Add(const SonarCycle& cycle, const Pose2& odom_from_base, const Stays& stays = {});
  /// Forgets what is too old at `now`; `waits` as in NearMap::Forget.
  void Forget(const Pose2& odom_from_base, Time now, bool waits = false);
  /// Time of the newest cycle.
  std::optional<Time> newest() const;

  /// Points on the arcs of all believed echoes, base frame of `odom_from_base`.
  std::vector<Eigen::Vector2d> Points(const Pose2& odom_from_base) const;
  /// What lies between the near echoes of neighbouring sensors. The beams leave wedges before the corners of
  /// the base, and the corner of a box gets through them unseen while its faces are seen on both sides: two
  /// echoes so near to each other are taken for one convex thing, whose inside holds the line between them.
  std::vector<Eigen::Vector2d> Bridges(const Pose2& odom_from_base) const;
  /// Places of things by the evidence of many echoes, base frame of `odom_from_base`.
  std::vector<Eigen::Vector2d> Evidence(const Pose2& odom_from_base, Time now) const {
    return evidence_.Things(odom_from_base, now);
  }
  /// Places of near things that no beam sees any more, base frame of `odom_from_base`.
  std::vector<Eigen::Vector2d> Remembered(const Pose2& odom_from_base) const {
    return near_map_.Points(odom_from_base);
  }

 private:
  struct Kept {
    SonarCycle cycle;
    Pose2 odom_from_base;
  };
  void NoteNearThings(const Stays& stays);
  std::array<std::optional<Eigen::Vector2d>, kSonars> NearEchoes(const Pose2& odom_from_base) const;
  double RangeOf(std::size_t index, int sensor) const;
  bool IsSuperseded(std::size_t index, int sensor) const;
  bool Agrees(std::size_t index, int sensor) const;

  EchoMemoryConfig config_;
  std::array<Pose2, kSonars> base_from_sonar_;
  std::deque<Kept> kept_;  ///< oldest first
  NearMap near_map_;
  EvidenceGrid evidence_;
};

}  // namespace priamos::robot
