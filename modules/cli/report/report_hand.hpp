#pragma once

#include <optional>
#include <string>

#include "cli/report/report_record.hpp"
#include "cli/scenario/true_world.hpp"
#include "common/ground_plan.hpp"

namespace priamos::cli {

/// How a drive by hand went, judged by the truth.
struct HandSummary {
  double wished_s = 0;    ///< how long a drive command asked for motion
  double free_m = 0;      ///< distance along the wishes that was truly free, see FreeMotion
  double achieved_m = 0;  ///< the part of it that the base made
  /// Longest time that it stood while the operator pushed, with its footprint in the passage or at most 30 cm
  /// before or behind it [s]; none when it was never there.
  std::optional<double> longest_stop_s;

  /// Motion achieved over the part of the wish that was free: 1 when all, 0 when the base stood though there
  /// was room. None when nothing that was wished was free.
  std::optional<double> honoured() const;
};

/// Summary of a drive by hand; nullopt if no command for motion was recorded. The free motion changes with
/// the acceleration that the robot grants an operator, and 0.1 s after the wish, so that starting and turning
/// back are no faults. Time spent before something that blocks the wished motion does not count, time spent
/// where there was room does.
std::optional<HandSummary> HandSummaryOf(const RunRecord& record, const TrueWorld& world,
                                         const std::optional<DoorPlan>& passage);

/// Why a drive by hand that came to its end has not passed, in words; empty if it has.
/// `longest_stop_s` as in Scenario.
std::string FaultOf(const HandSummary& hand, double longest_stop_s);

}  // namespace priamos::cli
