#include "robot/core/motion/detour_line.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace priamos::robot {

void DetourConfig::Describe(Archive& a) {
  a.Number("horizon_m", horizon_m, {"m", 0.5, 5, "distance ahead on the path"});
  a.Number("least_m", least_m, {"m", 0, 0.5, "nearer to a thing no detour leads"});
  a.Number("stop_m", stop_m, {"m", 0, 0.5, "nearer it leads only to get away"});
  a.Number("wish_m", wish_m, {"m", 0, 1, "nearer to a thing only where there is no room"});
  a.Number("replan_s", replan_s, {"s", 0.02, 5, "time between two searches"});
  if (least_m > stop_m || stop_m > wish_m) a.Refuse("stop_m", "between least_m and wish_m");
}

Detour::Detour(double from, double step, std::vector<double> offsets_m)
    : from_(from), step_(step), offsets_m_(std::move(offsets_m)) {
  leaves_ = std::any_of(offsets_m_.begin(), offsets_m_.end(), [](double offset) { return offset != 0; });
}

double Detour::At(double s) const {
  if (offsets_m_.empty()) return 0;
  const double place = std::clamp((s - from_) / step_, 0.0, static_cast<double>(offsets_m_.size() - 1));
  const auto k = static_cast<std::size_t>(place);
  if (k + 1 == offsets_m_.size()) return offsets_m_.back();
  return offsets_m_[k] + (place - static_cast<double>(k)) * (offsets_m_[k + 1] - offsets_m_[k]);
}

double Detour::SlopeAt(double s) const {
  return (At(s + step_ / 2) - At(s - step_ / 2)) / step_;
}

}  // namespace priamos::robot
