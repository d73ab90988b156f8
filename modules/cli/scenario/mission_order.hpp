#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/time.hpp"
#include "priamos/mission_command_t.hpp"
#include "priamos/mission_status_t.hpp"

namespace priamos::cli {

/// Name of a phase, as the constant of mission_status_t has it: "APPROACHING".
std::string_view PhaseName(int phase);
/// Whether a mission is being carried out.
bool IsRunning(const mission_status_t& status);
/// Whether a mission has ended, DONE or FAILED.
bool IsOver(const mission_status_t& status);

/// Outcome of an order.
enum class OrderOutcome {
  kOpen,      ///< not known yet
  kAccepted,  ///< the planner carries it out, and its end is not waited for
  kDone,      ///< the mission is done, or is aborted as was ordered
  kFailed,    ///< the mission failed
  kRefused,   ///< another mission is under way
  kNoAnswer,  ///< no planner, or one that does not take orders
};

std::string_view Text(OrderOutcome outcome);

/// An order to the planner and what it answers. The planner reports the state of its mission and does
/// not answer single orders, so its status before the order is compared with its status afterwards; times are
/// those of arrival, for the two may have different clocks. Pure: time and messages are given.
class MissionOrder {
 public:
  /// Order that stays open until the planner carries it out; with `to_the_end` until the mission is over.
  MissionOrder(const mission_command_t& order, bool to_the_end) : order_(order), to_the_end_(to_the_end) {}

  /// A status that arrived at `now`. Returns what is new in it for a person, in words.
  std::optional<std::string> Hear(const mission_status_t& status, Time now);
  /// The order when it is time to send it (again).
  std::optional<mission_command_t> Step(Time now);

  OrderOutcome outcome() const { return outcome_; }
  /// The planner's last status text, or why there is none.
  const std::string& text() const { return text_; }

 private:
  bool aborts() const { return order_.mission == mission_command_t::ABORT; }
  void End(OrderOutcome outcome, std::string text);
  void Judge(const mission_status_t& status, Time now);
  std::optional<mission_command_t> Send(Time now);

  mission_command_t order_;
  bool to_the_end_;
  OrderOutcome outcome_ = OrderOutcome::kOpen;
  std::string text_;
  std::optional<mission_status_t> before_, last_;  ///< the status when the order was given, and the newest
  bool answered_ = false;                          ///< the planner's status has changed since the order
  std::optional<Time> start_, first_sent_, sent_, heard_;
};

}  // namespace priamos::cli
