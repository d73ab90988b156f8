#include "head/floor_watch.hpp"

#include <fmt/format.h>

#include "common/archive.hpp"
#include "head/head_messages.hpp"

namespace priamos::head {

FloorWatch::FloorWatch(const HeadConfig& config, const HeadModel& head, bus::Context& context)
    : on_(config.laser.rate_hz > 0 && config.mode != "calibrate"),
      head_(head),
      watch_(config.laser),
      evaluator_(head, config.laser.obstacle),
      context_(context),
      obstacle_(context.node().Advertise(channels::kObstacleLine)) {
  if (!on_) return;
  const std::string table = context.ResolvePath(config.calibration);
  if (head_.lasers.empty())
    throw ConfigError(
        fmt::format("{}: lasers: expected the planes of the line lasers for laser.rate_hz above 0, got "
                    "none; calibrate it with `priamos calibrate --laser`",
                    table));
  if (LinesSeen(head_, config.WatchSetting()) == 0)
    throw ConfigError(fmt::format(
        "laser.tilt_deg: expected a tilt at which the third camera sees a line of the lasers in {}, "
        "got {:.1f} degrees",
        table, config.laser.tilt_deg));
}

LaserWatch::Action FloorWatch::Step(bool needed, bool exposing, const std::optional<HeadSetting>& rests_at,
                                    Time now) {
  if (!on_) return LaserWatch::Action::kWait;
  WatchMoment moment{.needed = needed, .exposing = exposing};
  if (rests_at) {
    const std::size_t n = LinesSeen(head_, *rests_at);
    moment.sees = n > 0;
    moment.sees_all = n == head_.lasers.size();
  }
  return watch_.Step(moment, rests_at.value_or(HeadSetting{}), now);
}

void FloorWatch::Evaluate(const std::optional<GreyImage>& picture, const HeadSetting& setting,
                          Time exposure) {
  const auto floor = evaluator_.Evaluate(picture, setting);
  if (!floor) return;
  obstacle_.Publish(ToMessage(floor->lines, exposure));
  if (floor->new_obstacle) context_.Log(bus::Level::kInfo, Describe(*floor->new_obstacle));
  if (floor->lines_lost)
    context_.Log(
        bus::Level::kWarning,
        fmt::format("{} pictures in a row showed no line of the lasers where the calibration has it: "
                    "are they on, and is it theirs (priamos calibrate --laser)?",
                    FloorEvaluator::kLostAfter));
}

}  // namespace priamos::head
