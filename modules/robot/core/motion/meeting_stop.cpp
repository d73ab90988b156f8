#include "robot/core/motion/meeting_stop.hpp"

namespace priamos::robot {

void MeetingStopConfig::Describe(Archive& a) {
  a.Number("within_s", within_s,
           {"s", 0, 5, "so long before they would meet the base stands; 0: it does not"});
  a.Number("patience_s", patience_s, {"s", 0, 60, "it stands for so long in a row at most"});
  a.Number("not_again_s", not_again_s, {"s", 0, 60, "and then drives for so long, whoever comes"});
}

bool MeetingStop::Stands(bool about_to_meet, Time now) {
  const bool goes_on = gone_on_ && now - *gone_on_ < FromSeconds(config_.not_again_s);
  if (!about_to_meet || goes_on) {
    since_.reset();
    return false;
  }
  if (!since_) since_ = now;
  if (now - *since_ < FromSeconds(config_.patience_s)) return true;
  gone_on_ = now;
  since_.reset();
  return false;
}

}  // namespace priamos::robot
