#pragma once

#include <deque>
#include <optional>
#include <string>

#include "common/archive.hpp"
#include "head/core/drift/stereo_drift.hpp"

namespace priamos::head {

/// Limits beyond which the cameras are no longer believed to be where the calibration has them.
struct DriftConfig {
  int looks = 3;                       ///< number of looks whose median is judged, odd; fewer are not judged
  double false_alarm = 1e-4;           ///< highest probability of a false alarm per judgement
  double calibration_sigma_px = 0.06;  ///< errors of each camera's calibration when nothing has moved

  void Describe(Archive& a);
};

/// A turn of the right camera that is too improbable under the calibration's errors.
struct DriftAlarm {
  StereoDrift drift;      ///< turn of the right camera in the median look
  int axis = 0;           ///< axis of the right camera (x, y, z) with the most improbable turn
  double deviations = 0;  ///< that turn in standard deviations

  /// One sentence that fits into HEALTH.
  std::string ToText() const;
};

/// Judges, for each axis, the median of the last looks' deviations: one look that went wrong raises no alarm.
/// What makes looks differ from the truth (a landmark that is not quite as modelled, the table between its
/// nodes) is much the same in all of them, so looks do not add up. The rate of false alarms is at most
/// `false_alarm` for each judgement whatever the looks have in common: if the median exceeds a limit, so does
/// more than half of the looks, which is at most twice as probable as that one of them does (Markov); three
/// axes and two sides make it twelve times.
class DriftMonitor {
 public:
  explicit DriftMonitor(const DriftConfig& config);

  void Add(const StereoDrift& drift);
  /// The alarm; nullopt while there is none or too few looks are known.
  std::optional<DriftAlarm> alarm() const { return alarm_; }
  /// Threshold of the alarm, in standard deviations.
  double limit() const { return limit_; }

 private:
  DriftConfig config_;
  double limit_;
  std::deque<StereoDrift> looks_;
  std::optional<DriftAlarm> alarm_;
};

/// The x that a standard normal variable exceeds with this probability, 1e-12 to 0.5.
double NormalQuantile(double exceeded_with);

}  // namespace priamos::head
