#pragma once

#include <array>
#include <optional>

#include "bus/context.hpp"
#include "head/core/doors/door_tracks.hpp"
#include "head/core/look/glance_evaluator.hpp"
#include "head/core/motion/ahead_watch.hpp"
#include "head/core/motion/side_watch.hpp"
#include "head/core/scene/scene_tracks.hpp"
#include "head/core/tracks/turn_taking.hpp"
#include "head/head_config.hpp"
#include "head/head_messages.hpp"

namespace priamos::head {

/// Looks around by itself while the base follows a path: to both sides of a corridor for doors, and ahead for
/// what stands on the floor. Tells both, and what looks show beside their landmark (DOOR_FOUND,
/// SCENE_OBJECT). It says where the head is to glance; who owns head and cameras takes the pictures.
class Glances {
 public:
  /// Throws ConfigError when glances are wanted where the cameras are not calibrated.
  Glances(const HeadConfig& config, const HeadModel& head, bus::Context& context);

  /// Takes the robot's pose. Where it is corrected, doors and objects move with it; where it begins anew
  /// elsewhere they are forgotten.
  void OnPose(const PoseSample& pose);
  /// The setting of a glance to begin now, if any; see GlanceRhythm::Step.
  std::optional<HeadSetting> Next(bool needed, bool glancing, Time now);
  /// Whether the base drives on a path on which the head glances ahead.
  bool LooksWhereItDrives() const { return ahead_.on() && Follows(false); }
  /// Whether that is one aside, which needs the stereo pair only.
  bool is_aside() const { return to_the_side_; }
  /// No glance for a while: a look is under way that others will follow.
  void Defer(Time now) {
    aside_.Defer(now);
    ahead_.Defer(now);
  }
  /// Takes the pictures of a glance, left, right and third, exposed at `robot` with the motors at `setting`.
  void Add(const std::array<std::optional<GreyImage>, 3>& pictures, const HeadSetting& setting,
           const PoseSample& robot);
  /// Takes what a look showed beside its landmark.
  void Add(const Scene& scene, const PoseSample& robot);
  /// Tells a door and an object, when it is time.
  void Tell(Time now);

 private:
  /// The last correction of the pose, and what it does to what was seen before.
  struct Correction {
    Time at;
    Pose2 new_from_old;
  };
  void Correct(const Correction& correction);
  Pose2 PlaceOf(const PoseSample& robot) const;
  bool Follows(bool corridor) const;
  double Bearing() const;

  HeadSetting base_;
  SideWatch aside_;
  AheadWatch ahead_;
  bool to_the_side_ = false;  ///< the glance under way is one of a corridor
  bool halfway_ = false;      ///< this one ahead is between the front and where the base drives
  GlanceEvaluator evaluator_;
  DoorTracks doors_;
  SceneTracks objects_;
  TurnTaking door_turns_, object_turns_;
  TurnTaking urgent_turns_{{.every_s = 0.4, .news_only = true}};  ///< of what hangs: for the robot's own bus
  std::optional<PoseSample> pose_;                                ///< newest
  std::optional<Correction> corrected_;
  bus::Latest<path_t> path_;
  bus::Publisher<door_found_t> door_found_;
  bus::Publisher<scene_object_t> scene_object_;
};

}  // namespace priamos::head
