#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <set>
#include <string>

#include "bus/node.hpp"
#include "common/pilot/repeated_order.hpp"
#include "console/core/browser_message.hpp"
#include "lcmtypes/channels.hpp"

namespace priamos::console {

/// Gives what pages wish of processes to whoever supervises them: one order at a time, again until it is
/// answered, for the radio carries the newest one only. Pure: time is an argument.
class ProcessOrders {
 public:
  static constexpr std::size_t kMostWaiting = 8;
  static constexpr std::size_t kMostKnown = 100;

  /// What supervisors tell; of anything else no wish is taken.
  void Know(const process_state_t& state);
  void Know(const simulation_t& simulation);
  /// Takes a wish; false for a process or scenario that is not known, and when too many wait. A wish that
  /// waits already does not wait twice.
  bool Wish(const ProcessWish& wish);
  void Answered(const process_report_t& report) { open_.Answered(report.request_id); }
  /// The order to send now, if there is one.
  std::optional<process_order_t> Step(Time now);

 private:
  std::set<std::string> processes_, scenarios_;
  std::deque<ProcessWish> waiting_;
  RepeatedOrder<process_order_t> open_;
};

/// Orders to processes on a bus, and what is heard of them there.
class ProcessChannels {
 public:
  /// `node` must outlive it.
  explicit ProcessChannels(bus::Node& node);

  /// As ProcessOrders::Wish.
  bool Wish(const ProcessWish& wish) { return orders_.Wish(wish); }
  void Tick(Time now);

 private:
  ProcessOrders orders_;
  bus::Inbox<process_state_t> states_;
  bus::Inbox<process_report_t> reports_;
  bus::Latest<simulation_t> simulation_;
  bus::Publisher<process_order_t> order_;
};

}  // namespace priamos::console
