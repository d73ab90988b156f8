#include "robot/drive_reporter.hpp"

#include <fmt/format.h>

#include "robot/robot_messages.hpp"

namespace priamos::robot {

void DriveReporter::Report(const DriveState& state) {
  if (state.holder != holder_) {
    holder_ = state.holder;
    context_.Log(
        bus::Level::kInfo,
        fmt::format("the lease is {}", state.holder.driver == Driver::kNobody
                                           ? "free"
                                           : fmt::format("held by {}, session {}", Text(state.holder.driver),
                                                         state.holder.session)));
  }
  const auto cause = state.failsafe.cause;
  if (cause == cause_) return;
  cause_ = cause;
  if (!cause) {
    context_.SetHealth(bus::Health::kOk);
    context_.Log(bus::Level::kInfo, "nothing stops the base any more");
    return;
  }
  context_.SetHealth(bus::Health::kDegraded, Text(*cause));
  context_.Log(bus::Level::kWarning, fmt::format("the base is stopped: {}", Text(*cause)));
}

void DriveReporter::Report(const Touch& touch) {
  context_.Log(bus::Level::kWarning,
               fmt::format("{} at {}{}",
                           touch.came ? "somebody touched the standing base" : "the base touched something",
                           SegmentsText(touch.segments),
                           touch.push_n > 0 ? fmt::format(", {:.0f} N", touch.push_n) : ""));
}

void DriveReporter::Report(const wheel_state_t& message) {
  if (bool(message.contested) == contested_) return;
  contested_ = message.contested;
  context_.Log(bus::Level::kWarning,
               contested_
                   ? fmt::format("the drive board holds the wheels: another process commands them, too; "
                                 "{} of its commands were not obeyed",
                                 message.foreign_commands)
                   : "the wheels are commanded by one process again");
}

}  // namespace priamos::robot
