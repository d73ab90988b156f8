#include "head/core/drift/drift_monitor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/geometry.hpp"

namespace priamos::head {
namespace {

constexpr const char* kTurned[] = {"up or down", "sideways (vergence)", "about its axis (roll)"};

double Deviations(const StereoDrift& look, int axis) {
  return look.turn_rad(axis) / std::sqrt(look.covariance(axis, axis));
}

/// The look in the middle of all, as one axis ranks them.
const StereoDrift& Median(const std::deque<StereoDrift>& looks, int axis) {
  std::vector<const StereoDrift*> ranked;
  ranked.reserve(looks.size());
  for (const StereoDrift& look : looks) ranked.push_back(&look);
  std::sort(ranked.begin(), ranked.end(),
            [&](const auto* a, const auto* b) { return Deviations(*a, axis) < Deviations(*b, axis); });
  return *ranked[ranked.size() / 2];
}

}  // namespace

double NormalQuantile(double exceeded_with) {
  double low = 0, high = 8;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (0.5 * std::erfc(middle / std::sqrt(2.0)) > exceeded_with ? low : high) = middle;
  }
  return (low + high) / 2;
}

void DriftConfig::Describe(Archive& a) {
  a.Integer("looks", looks, {"-", 1, 99, "looks whose median is judged"});
  if (looks % 2 == 0) a.Refuse("looks", "an odd number");
  a.Number("false_alarm", false_alarm, {"-", 1e-9, 0.1, "probability of a false alarm, at most, each time"});
  a.Number("calibration_sigma_px", calibration_sigma_px,
           {"px", 0.01, 5, "error of a camera that has not moved: table and motors"});
}

std::string DriftAlarm::ToText() const {
  return fmt::format("cameras out of calibration: right turned {:.3f} deg {}, {:.0f} sigma; calibrate again",
                     Degrees(drift.turn_rad(axis)), kTurned[axis], deviations);
}

DriftMonitor::DriftMonitor(const DriftConfig& config)
    : config_(config), limit_(NormalQuantile(config.false_alarm / 12)) {}

void DriftMonitor::Add(const StereoDrift& drift) {
  looks_.push_back(drift);
  if (looks_.size() > static_cast<std::size_t>(config_.looks)) looks_.pop_front();
  alarm_.reset();
  if (looks_.size() < static_cast<std::size_t>(config_.looks)) return;
  DriftAlarm worst;
  for (int axis = 0; axis < 3; ++axis) {
    const StereoDrift& median = Median(looks_, axis);
    const double deviations = std::abs(Deviations(median, axis));
    if (deviations > worst.deviations) worst = {median, axis, deviations};
  }
  if (worst.deviations > limit_) alarm_ = worst;
}

}  // namespace priamos::head
