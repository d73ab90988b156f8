#pragma once

#include <optional>
#include <vector>

#include "bus/context.hpp"
#include "lcmtypes/channels.hpp"
#include "robot/core/features/feature_store.hpp"
#include "robot/core/pose/localiser.hpp"
#include "robot/core/sonar/segment_finder.hpp"
#include "robot/robot_config.hpp"

namespace priamos::robot {

features_t ToMessage(const FeatureBatch& batch);

/// Finds walls, corners and edges in what the ring hears, and tells the planner of them until it has
/// acknowledged each.
class FeatureReporter {
 public:
  FeatureReporter(const RobotConfig& config, bus::Context& context);

  /// Takes a cycle of the ring, heard where `localiser` has the base. Returns the walls that it found or that
  /// grew by it.
  std::vector<const FoundSegment*> Hear(const SonarCycle& cycle, const Localiser& localiser, Time now);
  /// Looks for corners and edges in the cycle that was given last, once: a step later, since both at once
  /// take long.
  void HearPoints(const Localiser& localiser, Time now);
  /// Takes acknowledgements, and sends what is due.
  void Tick(const Localiser& localiser, Time now);

 private:
  Whereabouts BaseBy(const Localiser& localiser) const;
  FeatureStore& Store(Time now);

  FeatureStoreConfig config_;
  OdometryNoise noise_;
  bus::Context& context_;
  SegmentFinder finder_;
  PointFinder points_;
  std::optional<Time> points_heard_;   ///< of the cycle in which points are still to be looked for
  std::optional<FeatureStore> store_;  ///< begins with the first cycle: its name is that time
  int lost_ = 0;
  bus::Inbox<features_ack_t> acks_;
  bus::Publisher<features_t> features_;
};

}  // namespace priamos::robot
