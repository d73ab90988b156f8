#include "cli/scenario/door_story.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cli/scenario/mission_order.hpp"
#include "common/geometry.hpp"
#include "planner/planner_messages.hpp"

namespace priamos::cli {
namespace {

/// The planner answers an order with its next status; an order lost on a starting bus is given again.
constexpr Duration kOrderAgain = std::chrono::seconds(2);

}  // namespace

std::string LookText(const landmark_fix_t& look) {
  constexpr std::array<std::string_view, 3> kSides{"landmark", "left side", "right side"};
  const auto side = kSides[std::clamp<int>(look.side, 0, kSides.size() - 1)];
  if (look.verdict != landmark_fix_t::FOUND)
    return fmt::format("  {} not found: {}", side, planner::FixVerdictText(look.verdict));
  return fmt::format("  {} found: {} edges, 1 sigma {:.1f} cm and {:.2f} degrees", side, look.n_matched,
                     100 * std::hypot(look.sigma_x_m, look.sigma_y_m), Degrees(look.sigma_yaw_rad));
}

DoorStory::DoorStory(const StoryStage& stage)
    : scenario_(stage.scenario),
      progress_(stage.progress),
      alive_(stage.scenario, stage.onboard, stage.offboard),
      status_(stage.offboard.SubscribeAll(channels::kMissionStatus)),
      looks_(stage.offboard.SubscribeAll(channels::kLandmarkFix)),
      order_(stage.offboard.Advertise(channels::kMissionCommand)) {}

void DoorStory::Tick(Time now) {
  if (!start_) start_ = now;
  alive_.Listen();
  if (phase_ < mission_status_t::APPROACHING && alive_.Missing().empty()) GiveOrder(now);
  FollowMission(now);
  FollowLooks(now);
}

void DoorStory::GiveOrder(Time now) {
  if (ordered_ && now - *ordered_ < kOrderAgain) return;
  if (!ordered_) {
    progress_(now, "all processes are alive; order to the planner: pass the door");
    order_id_ = OrderNumber(now);
  }
  ordered_ = now;
  mission_command_t order{};
  order.utime = ToUtime(now);
  order.mission = mission_command_t::PASS_DOOR;
  order.order_id = order_id_;
  order.landmark_id = static_cast<std::int16_t>(scenario_.landmark_id);
  order_.Publish(order);
}

void DoorStory::FollowMission(Time now) {
  for (const auto& status : status_.Drain()) {
    if (!ordered_ || ended_ || status.phase == phase_) continue;
    phase_ = status.phase;
    text_ = status.text;
    progress_(now, text_);
    if (phase_ != mission_status_t::DONE && phase_ != mission_status_t::FAILED) continue;
    succeeded_ = phase_ == mission_status_t::DONE;
    ended_ = now;
  }
}

void DoorStory::FollowLooks(Time now) {
  for (const auto& look : looks_.Drain()) progress_(now, LookText(look));
}

bool DoorStory::Done(Time now) const {
  if (ended_) return now - *ended_ >= kAftermath;
  return start_ && Seconds(now - *start_) >= scenario_.time_limit_s;
}

std::string DoorStory::Reason() const {
  if (!ordered_) return fmt::format("no sign of life from {}", alive_.Missing());
  return ended_ ? text_ : TimeLimitReason(scenario_, text_);
}

template StoryKind KindOf<DoorStory>();

}  // namespace priamos::cli
