#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "cli/scenario/stand_confirmation.hpp"
#include "common/time.hpp"
#include "priamos/mission_command_t.hpp"
#include "priamos/mission_status_t.hpp"

namespace priamos::cli {

/// Name of a phase, as the constant of mission_status_t has it: "APPROACHING".
std::string_view PhaseName(int phase);
/// Whether a mission has ended, DONE or FAILED.
bool IsOver(const mission_status_t& status);

/// Outcome of an order.
enum class OrderOutcome {
  kOpen,       ///< not known yet
  kAccepted,   ///< the planner carries it out or has it wait, and its end is not waited for
  kDone,       ///< the order is done; what was to be aborted, paused, resumed or cancelled is so
  kFailed,     ///< the mission failed
  kCancelled,  ///< it was cancelled, or an order before it failed
  kRefused,    ///< the planner cannot carry it out, or there is nothing to abort, pause, resume or cancel
  kOrdered,    ///< the planner has ordered the robot to stand, which has not confirmed it
  kNoAnswer,   ///< no planner, or one that does not take orders
};

std::string_view Text(OrderOutcome outcome);

/// Number of an order that a story gives at `now`, the only one who orders.
std::int32_t OrderNumber(Time now);

/// An order to the planner and what becomes of it. The planner reports all orders by their numbers; one whose
/// number it does not report was lost, and is given again. Times are those of arrival, for the two may have
/// different clocks. Pure: time and messages are given.
class MissionOrder {
 public:
  /// Order that stays open until the planner carries it out or has it wait; with `to_the_end` until it is
  /// over. Without a number it gets one drawn with `seed`, which nobody else has: another one than the
  /// planner reports, and a new one when that turns out to be the number of an order with another title.
  MissionOrder(const mission_command_t& order, bool to_the_end, std::uint32_t seed)
      : order_(order), to_the_end_(to_the_end), drawn_(order.order_id == 0), numbers_(seed) {}

  /// A status that arrived at `now`. Returns what is new in it for a person, in words.
  std::optional<std::string> Hear(const mission_status_t& status, Time now);
  /// What the planner sends and the robot reports: an abort or a pause is done when the robot stands.
  void Hear(const path_t& path) { stand_.Hear(path); }
  void Hear(const drive_status_t& drive, Time now) { stand_.Hear(drive, now); }
  /// The order when it is time to send it (again).
  std::optional<mission_command_t> Step(Time now);

  OrderOutcome outcome() const { return outcome_; }
  /// The planner's last words about it, or why there are none.
  const std::string& text() const { return text_; }
  int id() const { return order_.order_id; }
  /// How its steps have ended so far.
  const std::vector<mission_result_t>& steps() const { return steps_; }

 private:
  bool IsMission() const;
  void End(OrderOutcome outcome, std::string text);
  void Judge(const mission_status_t& status, Time now);
  void JudgeMission(const mission_status_t& status, Time now);
  void JudgeMissing(Time now);
  void JudgeIntervention(const mission_status_t& status, Time now);
  void AwaitStanding(Time now);
  std::string DoneText() const;
  std::optional<std::string> NothingToDo(const mission_status_t& status) const;
  void DrawNumber();
  bool IsAnothers(const mission_status_t& status) const;
  void CollectSteps(const mission_status_t& status);
  std::optional<mission_command_t> Send(Time now);

  mission_command_t order_;
  bool to_the_end_;
  bool drawn_;  ///< its number is of numbers_
  std::mt19937 numbers_;
  OrderOutcome outcome_ = OrderOutcome::kOpen;
  std::string text_;
  std::optional<mission_status_t> last_;  ///< the newest one
  std::string told_;                      ///< to a person last
  bool answered_ = false;                 ///< the planner has reported the order
  std::vector<mission_result_t> steps_;
  std::optional<Time> start_, first_sent_, sent_, heard_;
  StandConfirmation stand_;
  std::optional<Time> braking_;        ///< since then the planner has the robot stand
  std::optional<Time> missing_since_;  ///< the planner reports it no longer
};

}  // namespace priamos::cli
