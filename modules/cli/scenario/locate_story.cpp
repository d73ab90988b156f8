#include "cli/scenario/locate_story.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/geometry.hpp"

namespace priamos::cli {
namespace {

/// A plan is wrong by up to 10 cm and 3 degrees, 16 cm at 3 m from a door; no place that is another one is
/// nearer.
constexpr double kRight_m = 0.45, kRight_deg = 8;
/// A pose of after the last correction has come over the radio by then.
constexpr double kPoseComes_s = 1;

}  // namespace

void LocateStory::Begin(Time now) {
  mission_command_t command{};
  command.mission = mission_command_t::LOCATE;
  Give(command);
  Report(now, "order to the planner: where am I?");
}

void LocateStory::Follow(Time now) {
  if (order().outcome() == OrderOutcome::kOpen) return;
  if (order().outcome() != OrderOutcome::kDone)
    return End(now, false,
               order().text().starts_with("ambiguous")
                   ? order().text()
                   : fmt::format("{}: {}", Text(order().outcome()), order().text()));
  if (!found_) found_ = now;
  if (Seconds(now - *found_) >= kPoseComes_s) Judge(now);
}

void LocateStory::Judge(Time now) {
  const pose_t* pose = pose_.get();
  if (!pose || !truth()) return End(now, false, "failed: no pose, or no truth to compare it with");
  const double off_m = std::hypot(pose->x_m - truth()->x_m, pose->y_m - truth()->y_m);
  const double off_deg = Degrees(std::abs(WrapAngle(pose->yaw_rad - truth()->yaw_rad)));
  const bool right = off_m <= kRight_m && off_deg <= kRight_deg;
  End(now, right,
      fmt::format("{}: {:.2f} m, {:.1f} deg off; {}", right ? "right" : "wrong", off_m, off_deg,
                  order().text()));
}

template StoryKind KindOf<LocateStory>();

}  // namespace priamos::cli
