#pragma once

#include <optional>
#include <string>

#include "bus/node.hpp"
#include "bus/parameters/parameter_messages.hpp"
#include "common/pilot/repeated_order.hpp"
#include "console/aim_sender.hpp"
#include "console/console_messages.hpp"
#include "console/core/browser_message.hpp"
#include "console/parameter_orders.hpp"
#include "console/process_orders.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::console {

class FoxgloveBridge;

/// Whether a page's message is written down whoever sends it; of the stick it is who holds it, and when.
bool IsOrder(const BrowserMessage& message);
/// Whether only a driver may send it. Anybody may stop the robot, and look.
bool NeedsDriver(const BrowserMessage& message);

/// What pages order but for driving and stopping, on a bus. What the radio may lose is said again.
class PageOrders {
 public:
  /// `node` and `bridge` must outlive it. `bridge`: is told what processes answer of their parameters.
  /// `session`: 0..255, so that a robot does not take the first order for one of an earlier station. `known`:
  /// how well a person can tell where the robot stands.
  PageOrders(bus::Node& node, FoxgloveBridge& bridge, int session, const PlaceSigma& known);

  void Know(const std::string& process, const ParameterTable& table) { parameters_.Know(process, table); }
  /// Each obeys an order; false when it is none for this robot.
  bool Take(const MissionOrder& order, Time now);
  bool Take(const PlaceOrder& order, Time now);
  bool Take(const AimOrder& order, Time now);
  bool Take(const AlarmSeen& seen, const std::string& who, Time now);
  bool Take(const ParameterWish& wish) { return parameters_.Wish(wish); }
  bool Take(const ProcessWish& wish) { return processes_.Wish(wish); }
  void Tick(Time now);

 private:
  void Place(Time now);
  void ChangeParameters(Time now);

  FoxgloveBridge& bridge_;
  PlaceSigma known_;
  int places_;  ///< number of the newest order that says where the robot stands
  RepeatedOrder<pose_reset_t> placing_;
  AimSender aiming_;
  ParameterOrders parameters_;
  ProcessChannels processes_;

  bus::Inbox<pose_correction_t> corrections_;
  bus::Inbox<parameter_value_t> parameter_values_;
  bus::Publisher<mission_command_t> mission_;
  bus::Publisher<head_aim_t> head_aim_;
  bus::Publisher<alarm_ack_t> alarm_ack_;
  bus::Publisher<pose_reset_t> place_;
  bus::Publisher<parameter_order_t> parameter_;
};

}  // namespace priamos::console
