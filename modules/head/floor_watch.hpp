#pragma once

#include <optional>

#include "bus/context.hpp"
#include "common/frame_store.hpp"
#include "head/core/camera/head_model.hpp"
#include "head/core/floor/laser_watch.hpp"
#include "head/core/look/floor_evaluator.hpp"
#include "head/head_config.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::head {

/// Watches the floor ahead by the lines of the lasers, wherever the third camera rests with one in view, and
/// reports what stands out of it (OBSTACLE_LINE). It says when to expose and when to turn the head down; who
/// owns head and cameras does so.
class FloorWatch {
 public:
  /// Throws ConfigError when the floor is to be watched and the lasers are not calibrated, or are not seen at
  /// the configured tilt.
  FloorWatch(const HeadConfig& config, const HeadModel& head, bus::Context& context);

  /// A report of the motors.
  void Report(const HeadSetting& setting, bool moving, Time time) { watch_.Report(setting, moving, time); }
  /// One time step: whether a look or an operator needs the head, whether a look's pictures are being taken
  /// now, and where the head rests (nullopt: nowhere). See LaserWatch::Step.
  LaserWatch::Action Step(bool needed, bool exposing, const std::optional<HeadSetting>& rests_at, Time now);
  /// Frame to expose after Action::kTrigger.
  std::int32_t frame_id() const { return watch_.frame_id(); }
  /// Where the head rested while this picture was exposed, if it is one of the floor; see LaserWatch::Takes.
  std::optional<HeadSetting> Takes(const FrameNotice& frame) { return watch_.Takes(frame); }
  /// Evaluates a picture of the floor and reports what it shows; nullopt: the picture is lost.
  void Evaluate(const std::optional<GreyImage>& picture, const HeadSetting& setting, Time exposure);

 private:
  bool on_;
  HeadModel head_;
  LaserWatch watch_;
  FloorEvaluator evaluator_;
  bus::Context& context_;
  bus::Publisher<obstacle_line_t> obstacle_;
};

}  // namespace priamos::head
