#include "console/page_orders.hpp"

#include <string_view>
#include <variant>

#include "console/foxglove_bridge.hpp"

namespace priamos::console {
namespace {

constexpr int kMostPlaces = 65535;

}  // namespace

bool IsOrder(const BrowserMessage& message) {
  if (const auto* wish = std::get_if<ParameterWish>(&message))
    return wish->kind != ParameterWish::Kind::kRead;
  if (const auto* wish = std::get_if<ProcessWish>(&message)) return wish->kind != ProcessWish::Kind::kLog;
  return std::holds_alternative<StopOrder>(message) ||
         (NeedsDriver(message) && !std::holds_alternative<StickReport>(message));
}

bool NeedsDriver(const BrowserMessage& message) {
  return !std::holds_alternative<StopOrder>(message) && !std::holds_alternative<ListenWish>(message) &&
         !std::holds_alternative<ReplayOrder>(message);
}

PageOrders::PageOrders(bus::Node& node, FoxgloveBridge& bridge, int session, const PlaceSigma& known)
    : bridge_(bridge),
      known_(known),
      places_(256 * session),
      processes_(node),
      corrections_(node.SubscribeAll(channels::kPoseCorrection)),
      parameter_values_(node.SubscribeAll(channels::kParameterValue)),
      mission_(node.Advertise(channels::kMissionCommand)),
      head_aim_(node.Advertise(channels::kHeadAim)),
      alarm_ack_(node.Advertise(channels::kAlarmAck)),
      place_(node.Advertise(channels::kPoseReset)),
      parameter_(node.Advertise(channels::kParameterOrder)) {}

bool PageOrders::Take(const MissionOrder& order, Time now) {
  mission_.Publish(ToMessage(order, now));
  return true;
}

bool PageOrders::Take(const PlaceOrder& order, Time now) {
  places_ = places_ % kMostPlaces + 1;
  placing_.Give(ToMessage(order, places_, known_, now), now);
  return true;
}

bool PageOrders::Take(const AimOrder& order, Time now) {
  aiming_.Give(ToMessage(order, now));
  return true;
}

/// Every station, and every page of it, is told who it was.
bool PageOrders::Take(const AlarmSeen& seen, const std::string& who, Time now) {
  alarm_ack_.Publish(ToMessage(seen, who, now));
  return true;
}

void PageOrders::Tick(Time now) {
  Place(now);
  if (const auto aim = aiming_.Step(now)) head_aim_.Publish(*aim);
  ChangeParameters(now);
  processes_.Tick(now);
}

/// The radio does not repeat what it loses of this: an answer of the robot ends it.
void PageOrders::Place(Time now) {
  for (const pose_correction_t& answer : corrections_.Drain()) placing_.Answered(answer.request_id);
  if (const auto order = placing_.Step(now)) place_.Publish(*order);
}

/// The pages see the answers as messages of their channel.
void PageOrders::ChangeParameters(Time now) {
  for (const parameter_value_t& answer : parameter_values_.Drain()) {
    parameters_.Answered(answer);
    if (answer.outcome == parameter_value_t::OTHER_TABLE) continue;  // its numbers mean other keys
    const bool done = answer.outcome == parameter_value_t::DONE;
    bridge_.HearParameter(std::string(bus::ProcessOfParameters(answer.process)), answer.key, answer.value,
                          answer.next_changed, done ? "" : bus::OutcomeText(answer.outcome));
  }
  if (const auto order = parameters_.Step(now)) parameter_.Publish(*order);
}

}  // namespace priamos::console
