#pragma once

#include <array>
#include <optional>

#include "bus/context.hpp"
#include "head/core/doors/door_news.hpp"
#include "head/core/doors/door_tracks.hpp"
#include "head/core/look/glance_evaluator.hpp"
#include "head/core/motion/side_watch.hpp"
#include "head/head_config.hpp"
#include "head/head_messages.hpp"

namespace priamos::head {

/// Looks for doors to both sides while the base follows a corridor, and tells them (DOOR_FOUND). It says
/// where the head is to glance; who owns head and cameras takes the pictures.
class DoorSearch {
 public:
  /// Throws ConfigError when glances are wanted where the cameras are not calibrated.
  DoorSearch(const HeadConfig& config, const HeadModel& head, bus::Context& context);

  /// Takes the robot's pose. Doors keep their places as long as the pose goes on where it was.
  void OnPose(const PoseSample& pose);
  /// The setting of a glance to begin now, if any; see SideWatch::Step.
  std::optional<HeadSetting> Next(bool needed, bool glancing, Time now);
  /// Takes the pictures of a glance, left and right, exposed at `robot` with the motors at `setting`.
  void Add(const std::array<std::optional<GreyImage>, 2>& pictures, const HeadSetting& setting,
           const PoseSample& robot);
  /// Tells a door, when it is time.
  void Tell(Time now);

 private:
  bool FollowsCorridor() const;

  HeadSetting base_;
  SideWatch watch_;
  GlanceEvaluator evaluator_;
  DoorTracks doors_;
  DoorNews news_;
  std::optional<PoseSample> pose_;  ///< newest
  bus::Latest<path_t> path_;
  bus::Publisher<door_found_t> found_;
};

}  // namespace priamos::head
