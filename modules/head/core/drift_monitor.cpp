#include "head/core/drift_monitor.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/geometry.hpp"

namespace priamos::head {
namespace {

constexpr const char* kTurned[] = {"up or down", "sideways (vergence)", "about its axis (roll)"};

StereoDrift Mean(const std::deque<StereoDrift>& looks) {
  StereoDrift mean;
  const auto n = static_cast<double>(looks.size());
  for (const StereoDrift& look : looks)
    mean.turn_rad += look.turn_rad / n, mean.covariance += look.covariance / n;
  return mean;
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
  a.Integer("looks", looks, {"-", 1, 100, "looks whose mean is judged"});
  a.Number("false_alarm", false_alarm, {"-", 1e-9, 0.1, "probability of a false alarm, at most, each time"});
  a.Number("calibration_sigma_px", calibration_sigma_px,
           {"px", 0.01, 5, "error of a camera that has not moved: table and motors"});
}

std::string DriftAlarm::ToText() const {
  return fmt::format("cameras out of calibration: right turned {:.3f} deg {}, {:.0f} sigma; calibrate again",
                     Degrees(drift.turn_rad(axis)), kTurned[axis], deviations);
}

DriftMonitor::DriftMonitor(const DriftConfig& config)
    : config_(config), limit_(NormalQuantile(config.false_alarm / 6)) {}  // two sides, three axes

void DriftMonitor::Add(const StereoDrift& drift) {
  looks_.push_back(drift);
  if (looks_.size() > static_cast<std::size_t>(config_.looks)) looks_.pop_front();
  alarm_.reset();
  if (looks_.size() < static_cast<std::size_t>(config_.looks)) return;
  DriftAlarm worst{Mean(looks_)};
  for (int axis = 0; axis < 3; ++axis) {
    const double z = std::abs(worst.drift.turn_rad(axis)) / std::sqrt(worst.drift.covariance(axis, axis));
    if (z > worst.deviations) worst.deviations = z, worst.axis = axis;
  }
  if (worst.deviations > limit_) alarm_ = worst;
}

}  // namespace priamos::head
