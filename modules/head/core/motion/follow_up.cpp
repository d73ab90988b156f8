#include "head/core/motion/follow_up.hpp"

namespace priamos::head {

void FollowConfig::Describe(Archive& a) {
  a.Number("within_m", within_m,
           {"m", 0, 5, "a driving base looks again by itself at what it found so near; 0: it does not"});
  a.Number("every_s", every_s, {"s", 0, 5, "from one exposure to the next of these looks"});
  a.Number("least_m_s", least_m_s, {"m/s", 0, 1, "a base that is slower stands"});
}

void FollowUp::Answered(bool found, Time exposure) {
  found_ = found ? std::optional(exposure) : std::nullopt;
}

bool FollowUp::Due(double distance_m, double speed_m_s, Time now) {
  if (!found_ || Seconds(now - *found_) < config_.every_s) return false;
  found_.reset();
  return distance_m < config_.within_m && speed_m_s > config_.least_m_s;
}

}  // namespace priamos::head
